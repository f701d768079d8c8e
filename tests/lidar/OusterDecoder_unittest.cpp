#include "lidar/OusterDecoder.h"

#include <gtest/gtest.h>

#include <map>

#include "captures.h"
#include "lidar/Crc64.h"

using namespace scanloom;

namespace
{
std::map<PacketKind, int> kindsOf(const OusterDecoder& decoder, const std::filesystem::path& capture)
{
  std::map<PacketKind, int> kinds;
  for (const auto& payload : payloadsOf(capture)) ++kinds[decoder.kind(payload)];
  return kinds;
}

struct Recording
{
  std::string capture, metadata;
  int lidar_packets, imu_packets;
};

const std::vector<Recording> kRecordings{
    {"OS-0-32-U1_v2.2.0_1024x10", "OS-0-32-U1_v2.2.0_1024x10", 64, 10},
    {"OS-1-32-G_v2.1.1_1024x10", "OS-1-32-G_v2.1.1_1024x10", 64, 0},
    {"OS-1-64_1024x10_fw20", "OS-1-64_sensor_config_reduced", 64, 11},
    {"OS-2-128-U1_v2.3.0_1024x10", "OS-2-128-U1_v2.3.0_1024x10", 64, 10},
    {"OS-1-128_v2.3.0_1024x10_lb_n3", "OS-1-128_v2.3.0_1024x10", 192, 30},
    {"OS-1-128_767798045_1024x10_20230712_120049", "OS-1-128_767798045_1024x10_20230712_120049", 8, 2},
    {"crc_test", "crc_test", 34, 10},
    {"windowed_frame1", "windowed_frame1_0", 17, 10},
    {"duplicate_id", "duplicate_id", 1, 0},
    {"shot_limiting_test", "shot_limiting_test", 1, 0},
};
}  // namespace

TEST(OusterDecoder, knowsEveryPacketOfEveryRecording)
{
  for (const Recording& r : kRecordings)
  {
    SCOPED_TRACE(r.capture);
    SCANLOOM_NEEDS_DATA(capture, kOusterCaptures + r.capture + ".pcap");
    SCANLOOM_NEEDS_DATA(metadata, kOusterCaptures + r.metadata + ".json");
    std::map<PacketKind, int> expected{{PacketKind::Lidar, r.lidar_packets}};
    if (r.imu_packets > 0) expected[PacketKind::Imu] = r.imu_packets;
    EXPECT_EQ(kindsOf(decoderOf(metadata), capture), expected);
  }
}
