#include "doctor/RawlogEvidence.h"

#include <gtest/gtest.h>

#include "doctor/DoctorFindings.h"
#include "mrpt_bridge/RawlogWriter.h"
#include "mrpt_bridge/RigObservations.h"
#include "rig/RigReplay.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"

using namespace scanloom;

TEST(RawlogEvidence, pointsAndImusTellTheSameAsThePacketsDid)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const std::string f = folder.string();
  const std::string ini = "[lidars]\ndriver = CMultiLidarSensor\nprocess_rate = 100\npcap_input = " + f +
                          "/recording.pcap\nextrinsics = " + f + "/extrinsics.txt\nimu_csv = " + f +
                          "/imu.csv\nlidar1_name = left\nlidar1_metadata = " + f +
                          "/left.json\nlidar2_name = right\nlidar2_metadata = " + f + "/right.json\n";
  const RigSettings settings = readRigSettings(Configuration::fromText(ini, "test.ini"), "lidars");
  const Rig rig = makeRig(settings);
  const TemporaryFolder temporary;
  {
    RawlogWriter writer(temporary / "a.rawlog", recordingHeader(rig), {});
    RigReplay replay(rig);
    while (const auto event = replay.next()) writer.write(*toObservation(*event, replay.setup(), settings.driver));
    writer.close();
  }

  const RawlogEvidence evidence = rawlogEvidence(temporary / "a.rawlog");
  EXPECT_EQ(evidence.damage, "");
  const RigExamination seen = examine(evidence.rig, {});
  ASSERT_EQ(seen.lidars.size(), 2u);
  for (const LidarExamination& lidar : seen.lidars)
  {
    EXPECT_LT(degreesBetween(lidar.ground->up, Eigen::Vector3d::UnitZ()), 3);
    EXPECT_NEAR(lidar.ground->sensor_height, 2.5, 0.1);
  }
  EXPECT_LT(seen.pairs.front().agreement->correction->offset.norm(), 0.03);
  ASSERT_EQ(seen.imus.size(), 3u);
  EXPECT_NEAR(*seen.imus[0].timing.rate, 200, 0.1);
  for (const Finding& finding : findingsOf(seen, {}))
    EXPECT_LE(finding.verdict, Verdict::Ok) << finding.about << ' ' << finding.measure << ' ' << finding.says;
}

TEST(RawlogEvidence, isRefusedForWhatIsNoRawlogOfOurs)
{
  EXPECT_THROW(rawlogEvidence("no such file"), std::runtime_error);
}
