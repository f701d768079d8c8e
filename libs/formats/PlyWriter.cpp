#include "formats/PlyWriter.h"

#include "formats/LittleEndianBuffer.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cstdint>
#include <string>

namespace scanloom
{
namespace
{
constexpr std::size_t kPaddedCountWidth = 20;  // digits of the largest 64-bit number
}  // namespace

PlyWriter::PlyWriter(const std::filesystem::path& path) : file_(path) {}

void PlyWriter::add(const PointCloud& points, Timestamp stamp, const Rigid& frame_T_points)
{
  if (!origin_)
  {
    origin_ = stamp;
    writeHeader();
  }
  LittleEndianBuffer buffer;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector3f position = (frame_T_points * points.position(i).cast<double>().eval()).cast<float>();
    for (const float coordinate : position) buffer.put(coordinate);
    buffer.put(static_cast<float>(points.intensity[i]));
    buffer.put(seconds(stamp - *origin_ + Duration{points.t[i]}));
    buffer.put(static_cast<std::uint16_t>(points.ring[i]));
    buffer.put(points.sensor_id[i]);
  }
  buffer.writeTo(file_.stream());
  size_ += points.size();
}

void PlyWriter::close()
{
  if (!origin_) origin_ = Timestamp{};
  file_.stream().seekp(0);
  writeHeader();
  file_.commit();
}

void PlyWriter::writeHeader()
{
  // The comment is padded, so that the header keeps its length when close() writes it again with the final count.
  const std::string count = std::to_string(size_);
  fmt::print(file_.stream(),
             "ply\nformat binary_little_endian 1.0\ncomment scanloom{}\ncomment time_origin_ns {}\n"
             "element vertex {}\nproperty float x\nproperty float y\nproperty float z\nproperty float intensity\n"
             "property double time\nproperty ushort ring\nproperty uchar sensor_id\nend_header\n",
             std::string(kPaddedCountWidth - count.size(), ' '), nanoseconds(*origin_), count);
}
}  // namespace scanloom
