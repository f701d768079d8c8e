#include "input/packets/internal/CaptureInfo.h"

#include <gtest/gtest.h>

#include "support/TestData.h"

namespace scanloom::capture_info_unittest
{
namespace
{
const std::string kFolder = "ouster/ouster-lidar+ouster-sdk/tests/pcaps/";
}

TEST(CaptureInfo, listsWhoSentWhatToWhichPort)
{
  SCANLOOM_NEEDS_DATA(capture, kFolder + "same_ports.pcap");  // INVENTORY: two sensors, one port, four datagrams
  const CaptureInfo info = captureInfo(capture, {});
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
  const CaptureInfo info = captureInfo(capture, {first.string(), second.string()});
  for (const DecodedCapture& lidar : info.lidars)
  {
    EXPECT_EQ(lidar.packets.at("lidar"), 1u) << lidar.lidar.serial;
    EXPECT_EQ(lidar.packets.at("imu"), 1u) << lidar.lidar.serial;
    EXPECT_EQ(lidar.imu_samples, 1u) << lidar.lidar.serial;
  }
  const CaptureInfo alone = captureInfo(capture, {first.string()});
  EXPECT_EQ(alone.lidars.front().packets.at("imu"), 1u);
}
}  // namespace scanloom::capture_info_unittest
