/** `scanloom record` from captures in which a lidar is missing. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/runProgram.h"

#include <fmt/format.h>

#include <fstream>

namespace scanloom::record_missing_lidar_unittest
{
namespace
{
using testing::HasSubstr;

Ended record(const std::string& lidars, const std::filesystem::path& capture)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "rig.ini") << "[lidars]\ndriver = CMultiLidarSensor\nprocess_rate = 100\npcap_input = "
                                    << capture.string() << '\n'
                                    << lidars;
  return runProgram(fmt::format("{}/scanloom record -c {} -o {} 2>&1", SCANLOOM_BIN_DIR, (folder / "rig.ini").string(),
                                (folder / "x.rawlog").string()));
}

std::string lidar(int number, const std::string& name, const std::filesystem::path& metadata)
{
  return fmt::format("lidar{0}_name = {1}\nlidar{0}_metadata = {2}\nlidar{0}_pose = [0 0 0 0 0 0]\n", number, name,
                     metadata.string());
}

const std::string kVlp16 = SCANLOOM_SOURCE_DIR "/params/lidars/velodyne_vlp16.json";
}  // namespace

TEST(Record, endsWithThreeAndNamesTheSenderWhereAllPacketsAreForeign)
{
  SCANLOOM_NEEDS_DATA(hdl32e, "other-lidars/MRPT+mrpt/modules/mrpt_data/tests/sample_velodyne_hdl32.pcap");
  const Ended ended = record(lidar(1, "front", kVlp16), hdl32e);
  EXPECT_EQ(ended.status, 3);
  EXPECT_THAT(ended.output, HasSubstr("lidar 'front' is in no scan"));
  EXPECT_THAT(ended.output, HasSubstr("500 datagrams from 192.168.17.162 to port 2368"));  // INVENTORY
}

TEST(Record, endsWithThreeWhereOneOfTwoLidarsSentNothing)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const Ended ended =
      record(lidar(1, "left", folder / "left.json") + lidar(2, "front", kVlp16), folder / "recording.pcap");
  EXPECT_EQ(ended.status, 3) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("lidar 'front' is in no scan: no packet of it came"));
  EXPECT_THAT(ended.output, HasSubstr("scans and"));
}

TEST(Record, readsAnEarlyVlp16WithTheCommonFile)
{
  SCANLOOM_NEEDS_DATA(early, "other-lidars/jerry73204+rust-lidar-utils/velodyne-test/test_files/velodyne_vlp16.pcap");
  const Ended ended = record(lidar(1, "front", kVlp16), early);
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("front: 2016 blocks sent"));  // 84 packets
}
}  // namespace scanloom::record_missing_lidar_unittest
