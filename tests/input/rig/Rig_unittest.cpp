#include "input/rig/internal/RigReplay.h"

#include <gtest/gtest.h>

#include <fstream>

#include "input/lidar/LidarModels.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/messageOf.h"
#include "support/recordedRig.h"

namespace scanloom::rig_unittest
{
namespace
{
std::string complaintAbout(const std::string& ini)
{
  return messageOf<ConfigError>(
      [&]
      {
        const Configuration configuration = Configuration::fromText(ini, "x.ini");
        readRigSettings(configuration, rigSection(configuration));
      });
}
}  // namespace

TEST(RigOptions, namesAnUnknownKeyWithItsPlaceAndTheNearestOne)
{
  EXPECT_EQ(complaintAbout(recordedRigSection("f", "lidar2_adress = 1.2.3.4\n")),
            "x.ini:11: [lidars] lidar2_adress is an unknown key: did you mean 'lidar2_address'?");
}

TEST(RigOptions, twoLidarsNeedTwoNames)
{
  EXPECT_NE(
      complaintAbout(
          "[rig]\ndriver = CMultiLidarSensor\nlidar1_name=a\nlidar1_metadata=m\nlidar2_name=a\nlidar2_metadata=m\n")
          .find("must differ"),
      std::string::npos);
}

TEST(RigOptions, aModelIsNoPathUnlessThereIsAFileOfThatName)
{
  const TemporaryFolder folder;
  EXPECT_EQ(metadataPathFrom("VLP-16", folder.path()), "VLP-16");
  EXPECT_EQ(metadataPathFrom("left.json", folder.path()), (folder / "left.json").string());
  std::ofstream(folder / "VLP-16") << "{}";
  EXPECT_EQ(metadataPathFrom("VLP-16", folder.path()), (folder / "VLP-16").string());
  EXPECT_EQ(capturePathsFrom("a.pcap , /b.pcap", "/in"), "/in/a.pcap, /b.pcap");
}

TEST(RigOptions, saysWhenNoSectionHasTheDriver)
{
  EXPECT_NE(complaintAbout("[rig]\ndriver = CVelodyneScanner\n").find("no section with 'driver = CMultiLidarSensor'"),
            std::string::npos);
}

TEST(Rig, namesTheKeyOfAnAddressThatIsNone)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const auto complaint = [&](const std::string& line)
  { return messageOf<ConfigError>([&] { makeRig(recordedRigSettings(folder, line)); }); };
  EXPECT_EQ(complaint("bind_address = 10.0.0\n"),
            "bind_address: '10.0.0' is no IP address: write it as 192.168.1.10 or fe80::1");
  EXPECT_EQ(complaint("lidar2_address = left\n"),
            "lidar 'right', key 'address': 'left' is no IP address: write it as 192.168.1.10 or fe80::1");
}

TEST(Rig, asksWhetherAPoseIsInMillimetres)
{
  const Configuration configuration = Configuration::fromText(
      "[rig]\ndriver = CMultiLidarSensor\nlidar1_metadata = VLP-16\nlidar1_pose = [1500 0 2500 0 0 0]\n", "x.ini");
  EXPECT_EQ(messageOf<ConfigError>([&] { makeRig(readRigSettings(configuration, "rig")); }),
            "lidar1_pose: 2915 m from the body's origin: in mm? Poses are x y z (m) yaw pitch roll (deg)");
}

TEST(Rig, saysThatTwoLidarsHaveTheMetadataOfOneSensor)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  RigSettings settings = recordedRigSettings(folder);
  settings.lidars[1].metadata = settings.lidars[0].metadata;
  const std::string serial = makeDecoder((folder / "left.json").string(), Rigid::identity())->description().serial;
  EXPECT_EQ(messageOf<ConfigError>([&] { makeRig(settings); }),
            "lidars 'left' and 'right': both have metadata of serial number " + serial +
                ": give each the metadata of its own sensor");
}

TEST(RigReplay, weavesBothLidarsOfARecordingWithExactAccounts)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  RigReplay replay(makeRig(recordedRigSettings(folder)));

  std::uint64_t columns = 0, body_imu = 0, scans = 0;
  Timestamp previous = Timestamp::min(), previous_imu = Timestamp::min(), end;
  while (auto event = replay.next())
  {
    if (const auto* imu = std::get_if<SensorImu>(&*event))
    {
      EXPECT_GE(imu->sample.stamp, previous_imu);
      previous_imu = imu->sample.stamp;
      body_imu += imu->sensor == SensorImu::kBody;
      continue;
    }
    const Scan& scan = std::get<Scan>(*event);
    EXPECT_TRUE(scans == 0 || scan.start == end);
    ++scans;
    end = scan.end();
    for (const Column& column : scan.columns)
    {
      EXPECT_GE(column.stamp, previous);
      previous = column.stamp;
      ++columns;
    }
  }
  // summary.json of the recording: 9590 and 9559 packets of 16 columns, nothing dropped; imu.csv has 6000 lines
  const std::uint64_t sent[] = {9590 * 16, 9559 * 16};
  EXPECT_EQ(body_imu, 6000u);
  EXPECT_GE(scans, 297u);  // of 30 s, less the first part of a period and the lidars' own start and end
  EXPECT_LE(scans, 300u);
  for (LidarIndex i : {0, 1})
  {
    const LidarCounters c = replay.account().lidars[i].counters;
    EXPECT_EQ(c.received, sent[i]);
    EXPECT_EQ(c.lost + c.late + c.duplicate + c.dropped + c.implausible + c.malformed_packets, 0u);
    EXPECT_EQ(c.emitted + c.before_start + c.invalid, sent[i]);
  }
  const RigAccount account = replay.account();
  EXPECT_EQ(columns, account.lidars[0].counters.emitted + account.lidars[1].counters.emitted);
  EXPECT_EQ(account.late_imu_samples, 0u);
  EXPECT_TRUE(account.unmatched.empty());
}

TEST(Rig, aLidarThatIsNotThereIsNamedWithTheOnesThatAre)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  EXPECT_THROW(makeRig(recordedRigSettings(folder), {"lef"}), ConfigError);
  EXPECT_EQ(makeRig(recordedRigSettings(folder), {"right"}).lidars.size(), 1u);
}
}  // namespace scanloom::rig_unittest
