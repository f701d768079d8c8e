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
constexpr std::uint64_t kMagic = 0x00636C6F75643101;  // no lidar's packets begin like this
constexpr std::size_t kColumnsAt = 8, kPointsAt = 12, kHeader = 16;
constexpr std::size_t kColumnBytes = 8 + 4 + 4, kPointBytes = 8 + 3 * 4 + 2;
constexpr std::size_t kCloudColumns = 4096;  // more would make the scan's order finer than lidars fire
constexpr double kLowestRate = 1, kHighestRate = 100;
constexpr int kMostCloudChannels = 256;
constexpr float kFarthest = 4e6F;  // m, in mm below 2^32

/** Points of about the same stamp. */
struct CloudColumn
{
  Timestamp stamp;  // of its first point
  std::uint32_t first = 0, points = 0;
};

bool isUsable(const TimedPoint& p)
{
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && (p.x != 0 || p.y != 0 || p.z != 0);
}

/** 0 where columns of equal stamps are few enough. */
Duration widthOfColumns(const std::vector<TimedPoint>& points)
{
  std::size_t stamps = points.empty() ? 0 : 1;
  for (std::size_t i = 1; i < points.size(); ++i) stamps += points[i].stamp != points[i - 1].stamp;
  if (stamps <= kCloudColumns) return Duration{0};
  return (points.back().stamp - points.front().stamp) / static_cast<std::int64_t>(kCloudColumns) + Duration{1};
}

std::vector<CloudColumn> columnsOf(const std::vector<TimedPoint>& points)
{
  const Duration width = widthOfColumns(points);
  std::vector<CloudColumn> columns;
  for (std::uint32_t i = 0; i < points.size(); ++i)
  {
    if (columns.empty() || points[i].stamp - columns.back().stamp > width) columns.push_back({points[i].stamp, i, 0});
    ++columns.back().points;
  }
  return columns;
}

/** Reads what cloudPacket() wrote, and trusts nothing in it. */
class CloudPacket
{
 public:
  explicit CloudPacket(Bytes bytes) : bytes_(bytes) {}

  /** Whether it begins like one, and its lengths agree. */
  bool isSound() const
  {
    return bytes_.size() >= kHeader && load<std::uint64_t>(bytes_, 0) == kMagic && columns() <= kCloudColumns + 1 &&
           bytes_.size() == kHeader + columns() * kColumnBytes + points() * kPointBytes;
  }

  std::size_t columns() const { return load<std::uint32_t>(bytes_, kColumnsAt); }

  /** Throws std::out_of_range for a column or a point that is not there. */
  CloudColumn column(std::size_t i) const
  {
    if (i >= columns()) throw std::out_of_range("CloudPacket: no such column");
    const Bytes at = bytes_.slice(kHeader + i * kColumnBytes, kColumnBytes);
    return {fromNanoseconds(load<std::int64_t>(at, 0)), load<std::uint32_t>(at, 8), load<std::uint32_t>(at, 12)};
  }

  TimedPoint point(std::size_t i) const
  {
    const Bytes at = bytes_.slice(kHeader + columns() * kColumnBytes + i * kPointBytes, kPointBytes);
    return {fromNanoseconds(load<std::int64_t>(at, 0)),
            load<float>(at, 8),
            load<float>(at, 12),
            load<float>(at, 16),
            at[20],
            at[21]};
  }

 private:
  std::size_t points() const { return load<std::uint32_t>(bytes_, kPointsAt); }

  Bytes bytes_;
};

class CloudDecoder final : public PacketDecoder
{
 public:
  CloudDecoder(const CloudMetadata& metadata, const Rigid& body_T_sensor)
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

  const LidarDescription& description() const override { return description_; }
  PacketHeader header(Bytes) const override { return {}; }
  std::vector<ImuSample> imuSamples(Bytes) const override { return {}; }

  PacketKind kindByHeader(Bytes packet) const override
  {
    return CloudPacket(packet).isSound() ? PacketKind::Lidar : PacketKind::Malformed;
  }

  void readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const override
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

  void appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                    PointCloud& points) const override
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

 private:
  LidarDescription description_;
  Eigen::Isometry3f body_T_sensor_;
};
}  // namespace

std::vector<std::uint8_t> cloudPacket(std::vector<TimedPoint> points)
{
  points.erase(std::remove_if(points.begin(), points.end(), [](const TimedPoint& p) { return !isUsable(p); }),
               points.end());
  std::stable_sort(points.begin(), points.end(),
                   [](const TimedPoint& a, const TimedPoint& b) { return a.stamp < b.stamp; });
  const std::vector<CloudColumn> columns = columnsOf(points);
  std::vector<std::uint8_t> bytes(kHeader + columns.size() * kColumnBytes + points.size() * kPointBytes);
  store(bytes, 0, kMagic);
  store(bytes, kColumnsAt, static_cast<std::uint32_t>(columns.size()));
  store(bytes, kPointsAt, static_cast<std::uint32_t>(points.size()));
  std::size_t at = kHeader;
  for (const CloudColumn& column : columns)
  {
    store(bytes, at, nanoseconds(column.stamp));
    store(bytes, at + 8, column.first);
    store(bytes, at + 12, column.points);
    at += kColumnBytes;
  }
  for (const TimedPoint& point : points)
  {
    store(bytes, at, nanoseconds(point.stamp));
    store(bytes, at + 8, point.x);
    store(bytes, at + 12, point.y);
    store(bytes, at + 16, point.z);
    bytes[at + 20] = point.intensity;
    bytes[at + 21] = point.ring;
    at += kPointBytes;
  }
  return bytes;
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

std::unique_ptr<PacketDecoder> makeCloudDecoder(const CloudMetadata& metadata, const Rigid& body_T_sensor)
{
  return std::make_unique<CloudDecoder>(metadata, body_T_sensor);
}
}  // namespace scanloom
