#include "base/formats/internal/CloudEncoding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr std::uint16_t kHeaderSize = 375, kPointSize = 30;
constexpr std::size_t kRecordHeaderSize = 54;
constexpr std::uint8_t kPointFormat = 6;
constexpr double kStep = 0.001;  // m, of the coordinates

/** LAS's "adjusted standard GPS time" is GPS time less 1e9 s; GPS time began in 1980 and is 18 s ahead since 2017. */
constexpr Duration kPosixOfGpsStart = 315964800s, kAheadOfUtc = 18s, kAdjustment = 1'000'000'000s;

/** 8 bits to the 16 that the specification asks for: the largest becomes the largest. */
std::uint16_t normalised(std::uint8_t intensity) { return static_cast<std::uint16_t>(257 * intensity); }

void putText(LittleEndianBuffer& buffer, std::string text, std::size_t size)
{
  text.resize(size, '\0');
  for (const char c : text) buffer.put(static_cast<std::uint8_t>(c));
}

template <typename T>
void putZeros(LittleEndianBuffer& buffer, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i) buffer.put(T{0});
}

class LasEncoding : public CloudEncoding
{
 public:
  LasEncoding(Timestamp origin, const Eigen::Vector3d& offset, std::string wkt)
    : origin_(origin), offset_(offset), wkt_(std::move(wkt))
  {
  }

  /** Table 3 of the specification. No date of the file's making: the same input gives the same bits. */
  std::string header(std::size_t points) const override
  {
    constexpr std::uint16_t kStandardGpsTime = 1, kWkt = 1 << 4;  // formats from 6 on have the second bit
    LittleEndianBuffer buffer;
    putText(buffer, "LASF", 4);
    buffer.put(std::uint16_t{0});  // file source
    buffer.put(static_cast<std::uint16_t>(kStandardGpsTime | kWkt));
    putZeros<std::uint8_t>(buffer, 16);  // project
    buffer.put(std::uint8_t{1});
    buffer.put(std::uint8_t{4});
    putText(buffer, "OTHER", 32);
    putText(buffer, "scanloom", 32);
    putZeros<std::uint16_t>(buffer, 2);  // date
    buffer.put(kHeaderSize);
    buffer.put(static_cast<std::uint32_t>(kHeaderSize + recordSize()));  // where the points begin
    buffer.put(std::uint32_t{wkt_.empty() ? 0U : 1U});                   // variable length records
    buffer.put(kPointFormat);
    buffer.put(kPointSize);
    putZeros<std::uint32_t>(buffer, 6);  // the counts of earlier versions
    for (int axis = 0; axis < 3; ++axis) buffer.put(kStep);
    for (const double coordinate : offset_) buffer.put(coordinate);
    for (int axis = 0; axis < 3; ++axis)
    {
      buffer.put(points > 0 ? offset_[axis] + kStep * highest_[axis] : 0.0);
      buffer.put(points > 0 ? offset_[axis] + kStep * lowest_[axis] : 0.0);
    }
    putZeros<std::uint64_t>(buffer, 2);  // waveforms, extended records
    buffer.put(std::uint32_t{0});
    buffer.put(static_cast<std::uint64_t>(points));
    buffer.put(static_cast<std::uint64_t>(points));  // first returns
    putZeros<std::uint64_t>(buffer, 14);             // later returns
    if (!wkt_.empty()) putReferenceSystem(buffer);
    std::ostringstream text;
    buffer.writeTo(text);
    return text.str();
  }

  /** Table 16. */
  void put(LittleEndianBuffer& buffer, const Eigen::Vector3d& position, Duration since_origin, const PointCloud& cloud,
           std::size_t i) override
  {
    for (int axis = 0; axis < 3; ++axis) buffer.put(steps(position[axis], axis));
    constexpr std::uint8_t kFirstOfOne = 1 | 1 << 4;
    const std::uint8_t lidar = cloud.sensor_id[i];
    buffer.put(normalised(cloud.intensity[i]));
    buffer.put(kFirstOfOne);
    buffer.put(static_cast<std::uint8_t>(lidar < 4 ? lidar << 4 : 0));  // scanner channel
    buffer.put(std::uint8_t{0});                                        // class: never classified
    buffer.put(cloud.ring[i]);
    buffer.put(std::int16_t{0});  // scan angle: not known
    buffer.put(static_cast<std::uint16_t>(lidar + 1));
    buffer.put(seconds(origin_.time_since_epoch() + since_origin - kPosixOfGpsStart + kAheadOfUtc - kAdjustment));
  }

 private:
  std::size_t recordSize() const { return wkt_.empty() ? 0 : kRecordHeaderSize + wkt_.size() + 1; }

  /** Tables 5 and 22: OGC coordinate system WKT record. */
  void putReferenceSystem(LittleEndianBuffer& buffer) const
  {
    constexpr std::uint16_t kWktRecord = 2112;
    buffer.put(std::uint16_t{0});  // reserved
    putText(buffer, "LASF_Projection", 16);
    buffer.put(kWktRecord);
    buffer.put(static_cast<std::uint16_t>(wkt_.size() + 1));
    putText(buffer, "", 32);  // description
    putText(buffer, wkt_, wkt_.size() + 1);
  }

  std::int32_t steps(double coordinate, int axis)
  {
    const double count = std::round(coordinate / kStep);
    if (!(std::abs(count) <= std::numeric_limits<std::int32_t>::max()))
      throw std::runtime_error(fmt::format(
          "a coordinate of {} m: a LAS file of millimetres reaches 2147 km from its first keyframe", coordinate));
    lowest_[axis] = std::min(lowest_[axis], count);
    highest_[axis] = std::max(highest_[axis], count);
    return static_cast<std::int32_t>(count);
  }

  Timestamp origin_;
  Eigen::Vector3d offset_;
  std::string wkt_;
  Eigen::Array3d lowest_ = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d highest_ = Eigen::Array3d::Constant(-std::numeric_limits<double>::infinity());
};
}  // namespace

std::unique_ptr<CloudEncoding> lasEncoding(Timestamp origin, const Eigen::Vector3d& offset, const std::string& wkt)
{
  return std::make_unique<LasEncoding>(origin, offset, wkt);
}
}  // namespace scanloom
