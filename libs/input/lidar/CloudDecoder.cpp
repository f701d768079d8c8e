#include "input/lidar/CloudDecoder.h"

#include "input/lidar/CloudPacket.h"
#include "input/lidar/MetadataKeys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr double kLowestRate = 1, kHighestRate = 100;
constexpr int kMostCloudChannels = 256;
constexpr float kFarthest = 4e6F;  // m, in mm below 2^32
}  // namespace

bool looksLikeCloud(const std::string& text)
{
  if (text.find("cloud") == std::string::npos) return false;  // spares parsing long files of makers
  try
  {
    return MetadataKeys(text, "").text("", "lidar") == "cloud";
  }
  catch (const std::invalid_argument&)
  {
    return false;
  }
}

CloudMetadata parseCloudMetadata(const std::string& text, const std::string& name)
{
  const MetadataKeys keys(text, name);
  CloudMetadata metadata;
  metadata.rate = keys.number("", "rate", kLowestRate, kHighestRate).value_or(metadata.rate);
  metadata.channels = keys.integer("", "channels", 1, kMostCloudChannels).value_or(metadata.channels);
  return metadata;
}

std::string toJson(const CloudMetadata& metadata)
{
  return fmt::format(R"({{"lidar": "cloud", "rate": {:g}, "channels": {}}})",
                     std::clamp(metadata.rate, kLowestRate, kHighestRate),
                     std::clamp(metadata.channels, 1, kMostCloudChannels));
}

CloudDecoder::CloudDecoder(const CloudMetadata& metadata, const Rigid& body_T_sensor)
{
  LidarDescription& d = description_;
  d.model = "PointCloud2";
  d.channels = metadata.channels;
  d.frame_rate = metadata.rate;
  d.columns_per_frame = d.columns_per_packet = static_cast<int>(kCloudColumns) + 1;
  d.last_column = d.columns_per_frame - 1;
  d.frame_id_modulus = 1;
  d.numbering = Numbering::Stamps;
  d.body_T_sensor = body_T_sensor;
  d.clock = "POINTS";
  body_T_sensor_.matrix() = body_T_sensor.matrix().cast<float>();
}

PacketKind CloudDecoder::kindByHeader(Bytes packet) const
{
  return CloudPacket(packet).isSound() ? PacketKind::Lidar : PacketKind::Malformed;
}

void CloudDecoder::readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const
{
  const CloudPacket cloud(packet);
  blocks.clear();
  for (std::size_t i = 0; i < cloud.columns(); ++i)
  {
    MeasurementBlock block;
    block.stamp = cloud.column(i).stamp;
    block.measurement_id = block.index = static_cast<std::uint16_t>(i);
    block.valid = block.stamp >= Timestamp{};
    blocks.push_back(block);
  }
}

void CloudDecoder::appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                                PointCloud& points) const
{
  const CloudPacket cloud(packet);
  const CloudColumn column = cloud.column(block_index);
  if (column.points == 0) return;
  cloud.point(std::size_t{column.first} + column.points - 1);  // throws before memory is taken for points not there
  const PointRoom to = points.room(column.points);
  std::size_t n = 0;
  for (std::size_t i = column.first; i < std::size_t{column.first} + column.points; ++i)
  {
    const TimedPoint point = cloud.point(i);
    const Eigen::Vector3f in_sensor(point.x, point.y, point.z);
    const float range = in_sensor.norm();
    const bool is_later = point.stamp >= column.stamp && column.stamp >= Timestamp{};
    if (!(range < kFarthest) || !is_later || point.stamp - column.stamp > 1s) continue;
    const Duration after = point.stamp - column.stamp;
    const Eigen::Vector3f in_body = body_T_sensor_ * in_sensor;
    to.x[n] = in_body.x();
    to.y[n] = in_body.y();
    to.z[n] = in_body.z();
    to.intensity[n] = point.intensity;
    to.t[n] = t + static_cast<std::int32_t>(after.count());
    to.ring[n] = point.ring;
    to.column[n] = static_cast<std::uint16_t>(block_index);
    to.sensor_id[n] = sensor_id;
    to.range[n] = static_cast<std::uint32_t>(std::lround(1000 * range));
    to.signal[n] = to.near_ir[n] = 0;
    ++n;
  }
  points.grow(n);
}
}  // namespace scanloom
