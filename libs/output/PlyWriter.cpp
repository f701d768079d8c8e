#include "output/PlyWriter.h"
#include "core/Bytes.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

namespace scanloom
{
namespace
{
constexpr std::size_t kVertexSize = 4 * sizeof(float) + sizeof(double) + sizeof(std::uint16_t) + sizeof(std::uint8_t);
constexpr std::size_t kPaddedCountWidth = 20;  // digits of the largest 64-bit number

template <typename T>
void put(std::vector<std::uint8_t>& bytes, std::size_t& offset, T value)
{
  store(bytes, offset, value);
  offset += sizeof(T);
}
}  // namespace

PlyWriter::PlyWriter(const std::filesystem::path& path) : file_(path) {}

void PlyWriter::add(const PointCloud& points, Timestamp stamp, const Rigid& frame_T_points)
{
  if (!origin_)
  {
    origin_ = stamp;
    writeHeader();
  }
  std::vector<std::uint8_t> bytes(points.size() * kVertexSize);
  std::size_t offset = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector3f position = (frame_T_points * points.position(i).cast<double>().eval()).cast<float>();
    for (const float coordinate : position) put(bytes, offset, coordinate);
    put(bytes, offset, static_cast<float>(points.intensity[i]));
    put(bytes, offset, seconds(stamp - *origin_ + Duration{points.t[i]}));
    put(bytes, offset, static_cast<std::uint16_t>(points.ring[i]));
    put(bytes, offset, points.sensor_id[i]);
  }
  file_.stream().write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
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
  // The comment takes up what the number of points leaves free: the header keeps its length when the number is known.
  const std::string count = std::to_string(size_);
  fmt::print(file_.stream(),
             "ply\nformat binary_little_endian 1.0\ncomment scanloom{}\ncomment time_origin_ns {}\n"
             "element vertex {}\nproperty float x\nproperty float y\nproperty float z\nproperty float intensity\n"
             "property double time\nproperty ushort ring\nproperty uchar sensor_id\nend_header\n",
             std::string(kPaddedCountWidth - count.size(), ' '), nanoseconds(*origin_), count);
}
}  // namespace scanloom
