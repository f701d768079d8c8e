/** MRPT's own decoder of Velodyne packets against ours, on the same recorded packets. */
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>
#include <cstring>

#include "input/lidar/captures.h"
#include "input/lidar/velodynePackets.h"
#include "support/shareFound.h"

namespace scanloom::velodyne_scan_unittest
{
namespace
{
struct Recording
{
  const char* model;
  const char* mrpt_model;
  const char* file;
};

std::vector<Eigen::Vector3f> decodedByMrpt(const std::vector<std::vector<std::uint8_t>>& packets,
                                           const std::string& model)
{
  mrpt::obs::CObservationVelodyneScan scan;
  scan.calibration = mrpt::obs::VelodyneCalibration::LoadDefaultCalibration(model);
  scan.minRange = 0;
  scan.maxRange = 1000;
  for (const auto& packet : packets)
  {
    mrpt::obs::CObservationVelodyneScan::TVelodyneRawPacket raw;
    static_assert(sizeof raw == kVelodynePacketBytes);
    std::memcpy(&raw, packet.data(), sizeof raw);
    scan.scan_packets.push_back(raw);
  }
  mrpt::obs::CObservationVelodyneScan::TGeneratePointCloudParameters all;
  all.minDistance = 0;
  scan.generatePointCloud(all);
  const auto& cloud = scan.point_cloud;
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) points.emplace_back(cloud.x[i], cloud.y[i], cloud.z[i]);
  return points;
}
}  // namespace

using VelodyneScan = testing::TestWithParam<Recording>;
INSTANTIATE_TEST_SUITE_P(
    Models, VelodyneScan,
    testing::Values(Recording{"vlp16", "VLP16", "Kitware+VeloView/Testing/Data/vlp-16-test-90deg-1-50-frames.pcap"},
                    Recording{"hdl32e", "HDL32", "MRPT+mrpt/modules/mrpt_data/tests/sample_velodyne_hdl32.pcap"}),
    [](const auto& recording) { return std::string(recording.param.model); });

/** MRPT takes 16 readings of 32 from packets that say HDL-32E, as both recordings do, and turns the rotor on by laser.
 */
TEST_P(VelodyneScan, consistsOfPointsOfOurs)
{
  SCANLOOM_NEEDS_DATA(capture, std::string("other-lidars/") + GetParam().file);
  VelodyneMetadata metadata = velodyneMetadata(GetParam().model);
  metadata.product_id = 0x21;                                                              // also of early VLP-16s
  std::fill(metadata.vertical_offset_mm.begin(), metadata.vertical_offset_mm.end(), 0.0);  // not in MRPT's calibration
  const auto decoder = makeVelodyne(metadata, Rigid::identity());
  std::vector<std::vector<std::uint8_t>> packets = payloadsOf(capture);
  packets.erase(std::remove_if(packets.begin(), packets.end(),
                               [&](const auto& packet) { return decoder->kind(packet) != PacketKind::Lidar; }),
                packets.end());
  const auto ours = positionsOf(everyPoint(*decoder, packets)), theirs = decodedByMrpt(packets, GetParam().mrpt_model);
  EXPECT_GT(theirs.size(), 0.49 * static_cast<double>(ours.size()));
  EXPECT_GT(shareFound(theirs, ours, 0.02), 0.999) << "their angles come in steps of 0.01 degrees";
}
}  // namespace scanloom::velodyne_scan_unittest
