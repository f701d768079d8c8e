#include "input/rig/internal/RigReplay.h"

#include <gtest/gtest.h>

#include <fstream>

#include "input/lidar/LidarModels.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"

namespace scanloom::rig_unittest
{
namespace
{
std::string iniOf(const std::string& folder, const std::string& more = "")
{
  return "[rig]\ndriver = CMultiLidarSensor\nprocess_rate = 100\npcap_input = " + folder +
         "/recording.pcap\nextrinsics = " + folder + "/extrinsics.txt\nimu_csv = " + folder +
         "/imu.csv\nlidar1_name = left\nlidar1_metadata = " + folder +
         "/left.json\nlidar2_name = right\nlidar2_metadata = " + folder + "/right.json\n" + more;
}

std::string complaintAbout(const std::string& ini)
{
  try
  {
    const Configuration configuration = Configuration::fromText(ini, "x.ini");
    readRigSettings(configuration, rigSection(configuration));
  }
  catch (const ConfigError& error)
  {
    return error.what();
  }
  return "";
}
}  // namespace

TEST(RigOptions, namesAnUnknownKeyWithItsPlaceAndTheNearestOne)
{
  EXPECT_EQ(complaintAbout(iniOf("f", "lidar2_adress = 1.2.3.4\n")),
            "x.ini:11: [rig] lidar2_adress is an unknown key: did you mean 'lidar2_address'?");
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
  {
    const Configuration configuration = Configuration::fromText(iniOf(folder.string(), line), "x.ini");
    try
    {
      makeRig(readRigSettings(configuration, "rig"));
    }
    catch (const ConfigError& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint("bind_address = 10.0.0\n"),
            "bind_address: '10.0.0' is no IP address: write it as 192.168.1.10 or fe80::1");
  EXPECT_EQ(complaint("lidar2_address = left\n"),
            "lidar 'right', key 'address': 'left' is no IP address: write it as 192.168.1.10 or fe80::1");
}

TEST(Rig, asksWhetherAPoseIsInMillimetres)
{
  const Configuration configuration = Configuration::fromText(
      "[rig]\ndriver = CMultiLidarSensor\nlidar1_metadata = VLP-16\nlidar1_pose = [1500 0 2500 0 0 0]\n", "x.ini");
  try
  {
    makeRig(readRigSettings(configuration, "rig"));
    FAIL() << "accepted";
  }
  catch (const ConfigError& error)
  {
    EXPECT_EQ(std::string(error.what()),
              "lidar1_pose: 2915 m from the body's origin: in mm? Poses are x y z (m) yaw pitch roll (deg)");
  }
}

TEST(Rig, saysThatTwoLidarsHaveTheMetadataOfOneSensor)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  std::string ini = iniOf(folder.string());
  ini.replace(ini.find("/right.json"), 11, "/left.json");
  const Configuration configuration = Configuration::fromText(ini, "x.ini");
  const std::string serial = makeDecoder((folder / "left.json").string(), Rigid::identity())->description().serial;
  try
  {
    makeRig(readRigSettings(configuration, "rig"));
    FAIL() << "accepted";
  }
  catch (const ConfigError& error)
  {
    EXPECT_EQ(std::string(error.what()), "lidars 'left' and 'right': both have metadata of serial number " + serial +
                                             ": give each the metadata of its own sensor");
  }
}

TEST(RigReplay, weavesBothLidarsOfARecordingWithExactAccounts)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const Configuration configuration = Configuration::fromText(iniOf(folder.string()), "x.ini");
  RigReplay replay(makeRig(readRigSettings(configuration, "rig")));

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
  const Configuration configuration = Configuration::fromText(iniOf(folder.string()), "x.ini");
  EXPECT_THROW(makeRig(readRigSettings(configuration, "rig"), {"lef"}), ConfigError);
  EXPECT_EQ(makeRig(readRigSettings(configuration, "rig"), {"right"}).lidars.size(), 1u);
}
}  // namespace scanloom::rig_unittest
