#include "base/formats/internal/CloudEncoding.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
class PlyEncoding : public CloudEncoding
{
 public:
  PlyEncoding(Timestamp origin, const Eigen::Vector3d& offset) : origin_(origin), offset_(offset) {}

  std::string header(std::size_t points) const override
  {
    constexpr std::size_t kLongestCount = 20;  // digits of the largest 64-bit number
    const std::string count = std::to_string(points);
    return fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment scanloom{}\ncomment time_origin_ns {}\n{}"
        "element vertex {}\nproperty float x\nproperty float y\nproperty float z\nproperty float intensity\n"
        "property double time\nproperty ushort ring\nproperty uchar sensor_id\nend_header\n",
        std::string(kLongestCount - count.size(), ' '), nanoseconds(origin_), offsetLine("comment", offset_), count);
  }

  void put(LittleEndianBuffer& buffer, const Eigen::Vector3d& position, Duration since_origin, const PointCloud& cloud,
           std::size_t i) override
  {
    for (const double coordinate : position) buffer.put(static_cast<float>(coordinate));
    buffer.put(static_cast<float>(cloud.intensity[i]));
    buffer.put(seconds(since_origin));
    buffer.put(static_cast<std::uint16_t>(cloud.ring[i]));
    buffer.put(cloud.sensor_id[i]);
  }

 private:
  Timestamp origin_;
  Eigen::Vector3d offset_;
};
}  // namespace

std::unique_ptr<CloudEncoding> plyEncoding(Timestamp origin, const Eigen::Vector3d& offset, const std::string&)
{
  return std::make_unique<PlyEncoding>(origin, offset);
}
}  // namespace scanloom
