#include "input/packets/internal/CaptureInfo.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "support/TestData.h"

namespace scanloom::capture_info_unittest
{
namespace
{
const std::string kFolder = "ouster/ouster-lidar+ouster-sdk/tests/pcaps/";
}

class Digested : public testing::TestWithParam<const char*>
{
};

TEST_P(Digested, everyFieldEqualsTheMakersDecode)
{
  SCANLOOM_NEEDS_DATA(capture, kFolder + GetParam() + ".pcap");
  SCANLOOM_NEEDS_DATA(metadata, kFolder + GetParam() + ".json");
  SCANLOOM_NEEDS_DATA(digest, kFolder + GetParam() + "_digest.json");
  const auto expected = nlohmann::json::parse(std::ifstream(digest)).at("scans");
  const CaptureInfo info = captureInfo(capture, {metadata.string()}, Digests::Yes);

  ASSERT_EQ(info.lidars.front().digests.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    for (const auto& [field, md5] : expected[i].items())
    {
      if (field == "ENCODER_COUNT") continue;  // obsolete
      EXPECT_EQ(info.lidars.front().digests[i].at(field), md5.get<std::string>()) << field;
    }
}

INSTANTIATE_TEST_SUITE_P(Recordings, Digested,
                         testing::Values("OS-1-32-G_v2.1.1_1024x10", "OS-0-32-U1_v2.2.0_1024x10",
                                         "OS-2-128-U1_v2.3.0_1024x10"));

TEST(CaptureInfo, listsWhoSentWhatToWhichPort)
{
  SCANLOOM_NEEDS_DATA(capture, kFolder + "same_ports.pcap");  // INVENTORY: two sensors, one port, four datagrams
  const CaptureInfo info = captureInfo(capture, {}, Digests::No);
  ASSERT_EQ(info.streams.size(), 2u);
  std::uint64_t datagrams = 0;
  for (const CaptureStream& stream : info.streams)
  {
    EXPECT_EQ(stream.destination_port, 7502);
    EXPECT_EQ(stream.smallest, 48u);
    datagrams += stream.datagrams;
  }
  EXPECT_EQ(datagrams, 4u);
}

TEST(CaptureInfo, creditsAnImuPacketToTheLidarThatSendsFromItsAddress)
{
  SCANLOOM_NEEDS_DATA(capture, kFolder + "same_ports.pcap");  // of each sensor a lidar and an IMU packet, one port
  SCANLOOM_NEEDS_DATA(first, kFolder + "same_ports.1.json");
  SCANLOOM_NEEDS_DATA(second, kFolder + "same_ports.2.json");
  const CaptureInfo info = captureInfo(capture, {first.string(), second.string()}, Digests::No);
  for (const DecodedCapture& lidar : info.lidars)
  {
    EXPECT_EQ(lidar.packets.at("lidar"), 1u) << lidar.lidar.serial;
    EXPECT_EQ(lidar.packets.at("imu"), 1u) << lidar.lidar.serial;
    EXPECT_EQ(lidar.imu_samples, 1u) << lidar.lidar.serial;
  }
  const CaptureInfo alone = captureInfo(capture, {first.string()}, Digests::No);
  EXPECT_EQ(alone.lidars.front().packets.at("imu"), 1u);
}
}  // namespace scanloom::capture_info_unittest
