#include "base/formats/internal/CloudEncoding.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
class PcdEncoding : public CloudEncoding
{
 public:
  PcdEncoding(Timestamp origin, const Eigen::Vector3d& offset) : origin_(origin), offset_(offset) {}

  std::string header(std::size_t points) const override
  {
    constexpr std::size_t kLongestCounts = 40;  // digits of the two counts
    const std::string count = std::to_string(points);
    return fmt::format(
        "# .PCD v0.7 - Point Cloud Data file format{0}\n# time_origin_ns {1}\n{3}VERSION 0.7\n"
        "FIELDS x y z intensity t ring column sensor_id\nSIZE 4 4 4 4 8 2 2 1\nTYPE F F F F F U U U\n"
        "COUNT 1 1 1 1 1 1 1 1\nWIDTH {2}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {2}\nDATA binary\n",
        std::string(kLongestCounts - 2 * count.size(), ' '), nanoseconds(origin_), count, offsetLine("#", offset_));
  }

  void put(LittleEndianBuffer& buffer, const Eigen::Vector3d& position, Duration since_origin, const PointCloud& cloud,
           std::size_t i) override
  {
    for (const double coordinate : position) buffer.put(static_cast<float>(coordinate));
    buffer.put(static_cast<float>(cloud.intensity[i]));
    buffer.put(seconds(since_origin));
    buffer.put(static_cast<std::uint16_t>(cloud.ring[i]));
    buffer.put(cloud.column[i]);
    buffer.put(cloud.sensor_id[i]);
  }

 private:
  Timestamp origin_;
  Eigen::Vector3d offset_;
};
}  // namespace

std::unique_ptr<CloudEncoding> pcdEncoding(Timestamp origin, const Eigen::Vector3d& offset, const std::string&)
{
  return std::make_unique<PcdEncoding>(origin, offset);
}
}  // namespace scanloom
