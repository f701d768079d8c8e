#pragma once
#include "input/lidar/PacketDecoder.h"

#include <string>

namespace scanloom
{
/** What is known of a lidar by its clouds; as JSON {"lidar": "cloud", "rate": 10, "channels": 64}. */
struct CloudMetadata
{
  double rate = 10;  // Hz, 1 to 100: clouds a second, each a turn
  int channels = 1;  // 1 to 256
};

bool looksLikeCloud(const std::string& text);

/** Throws std::invalid_argument with file, key and what is expected. */
CloudMetadata parseCloudMetadata(const std::string& text, const std::string& name);
std::string toJson(const CloudMetadata&);

/**
 * Clouds with a stamp per point (CloudPacket.h): a packet is a turn, a block its points of one stamp. A block waits a
 * turn longer than those of other lidars, which the batcher adds to deadline_ms by itself: columns_per_packet is a
 * turn.
 */
class CloudDecoder : public PacketDecoder
{
 public:
  CloudDecoder(const CloudMetadata&, const Rigid& body_T_sensor);

  const LidarDescription& description() const override { return description_; }
  PacketKind kindByHeader(Bytes packet) const override;
  PacketHeader header(Bytes) const override { return {}; }
  void readBlocks(Bytes packet, std::vector<MeasurementBlock>&) const override;
  void appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                    PointCloud&) const override;
  std::vector<ImuSample> imuSamples(Bytes) const override { return {}; }

 private:
  LidarDescription description_;
  Eigen::Isometry3f body_T_sensor_;
};
}  // namespace scanloom
