#include "input/lidar/CloudPacket.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr std::uint64_t kMagic = 0x00636C6F75643101;  // no lidar's packets begin like this
constexpr std::size_t kColumnsAt = 8, kPointsAt = 12, kHeader = 16;
constexpr std::size_t kColumnBytes = 8 + 4 + 4, kPointBytes = 8 + 3 * 4 + 2;

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

bool CloudPacket::isSound() const
{
  return bytes_.size() >= kHeader && load<std::uint64_t>(bytes_, 0) == kMagic && columns() <= kCloudColumns + 1 &&
         bytes_.size() == kHeader + columns() * kColumnBytes + points() * kPointBytes;
}

std::size_t CloudPacket::columns() const { return load<std::uint32_t>(bytes_, kColumnsAt); }
std::size_t CloudPacket::points() const { return load<std::uint32_t>(bytes_, kPointsAt); }

CloudColumn CloudPacket::column(std::size_t i) const
{
  if (i >= columns()) throw std::out_of_range("CloudPacket: no such column");
  const Bytes at = bytes_.slice(kHeader + i * kColumnBytes, kColumnBytes);
  return {fromNanoseconds(load<std::int64_t>(at, 0)), load<std::uint32_t>(at, 8), load<std::uint32_t>(at, 12)};
}

TimedPoint CloudPacket::point(std::size_t i) const
{
  const Bytes at = bytes_.slice(kHeader + columns() * kColumnBytes + i * kPointBytes, kPointBytes);
  return {fromNanoseconds(load<std::int64_t>(at, 0)),
          load<float>(at, 8),
          load<float>(at, 12),
          load<float>(at, 16),
          at[20],
          at[21]};
}
}  // namespace scanloom
