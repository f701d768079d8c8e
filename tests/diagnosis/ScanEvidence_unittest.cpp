#include "diagnosis/ScanEvidence.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/formats/CloudWriter.h"
#include "diagnosis/DoctorFindings.h"
#include "input/rig/CloudsInput.h"
#include "input/rig/internal/RigReplay.h"
#include "mrpt/observations/RawlogInput.h"
#include "mrpt/observations/RawlogWriter.h"
#include "mrpt/observations/RigObservations.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/harvesterSettings.h"
#include "support/recordedRig.h"

namespace scanloom::scan_evidence_unittest
{
TEST(ScanEvidence, pointsAndImusTellTheSameAsThePacketsDid)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const RigSettings settings = recordedRigSettings(folder);
  const Rig rig = makeRig(settings);
  const TemporaryFolder temporary;
  {
    RawlogWriter writer(temporary / "a.rawlog", recordingHeader(rig), {});
    RigReplay replay(rig);
    while (const auto event = replay.next()) writer.write(*toObservation(*event, replay.setup(), settings.driver));
    writer.close();
  }

  RawlogInput input(temporary / "a.rawlog");
  const RigExamination seen = examine(scanEvidence(input, true, [] { return true; }), harvesterSettings().crop);
  EXPECT_TRUE(input.takeWarnings().empty()) << "nothing is damaged";
  ASSERT_EQ(seen.lidars.size(), 2u);
  for (const LidarExamination& lidar : seen.lidars)
  {
    EXPECT_LT(degreesBetween(lidar.ground->up, Eigen::Vector3d::UnitZ()), 3);
    EXPECT_NEAR(lidar.ground->sensor_height, 2.5, 0.1);
  }
  EXPECT_LT(seen.pairs.front().agreement->correction->offset.norm(), 0.03);
  ASSERT_EQ(seen.imus.size(), 3u);
  EXPECT_NEAR(*seen.imus[0].timing.rate, 200, 0.1);
  for (const Finding& finding : findingsOf(seen))
    EXPECT_LE(finding.verdict, Verdict::Ok) << finding.about << ' ' << finding.measure << ' ' << finding.says;
}

/** A field of 40 m by 40 m, 2 m below the lidar. */
PointCloud field()
{
  PointCloud points;
  points.resize(81 * 81);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points.x[i] = -20 + 0.5F * static_cast<float>(i % 81);
    points.y[i] = -20 + 0.5F * static_cast<float>(i / 81);
    points.z[i] = -2;
  }
  return points;
}

TEST(ScanEvidence, cloudsTellTheGroundButNoDelivery)
{
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> clouds;
  for (int i = 0; i < 5; ++i)
  {
    clouds.push_back(folder / fmt::format("{}.pcd", i));
    CloudWriter writer(clouds.back());
    writer.add(field(), Timestamp{}, Rigid::identity());
    writer.close();
  }
  CloudsInput input(clouds);

  const RigExamination seen = examine(scanEvidence(input, false, [] { return true; }));
  ASSERT_EQ(seen.lidars.size(), 1u);
  ASSERT_TRUE(seen.lidars[0].ground);
  EXPECT_NEAR(seen.lidars[0].ground->sensor_height, 2, 0.01);
  EXPECT_LT(degreesBetween(seen.lidars[0].ground->up, Eigen::Vector3d::UnitZ()), 0.1);
  for (const Finding& finding : findingsOf(seen)) EXPECT_LE(finding.verdict, Verdict::Ok) << finding.says;
}
}  // namespace scanloom::scan_evidence_unittest
