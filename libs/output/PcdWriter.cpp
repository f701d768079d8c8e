#include "output/PcdWriter.h"

#include "config/AtomicFile.h"
#include "core/Bytes.h"
#include "core/Time.h"

#include <fmt/format.h>

#include <ostream>
#include <vector>

namespace scanloom
{
namespace
{
constexpr std::size_t kPointSize = 5 * sizeof(float) + 2 * sizeof(std::uint16_t) + sizeof(std::uint8_t);

std::string headerOf(std::size_t points)
{
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity t ring column sensor_id\n"
      "SIZE 4 4 4 4 4 2 2 1\nTYPE F F F F F U U U\nCOUNT 1 1 1 1 1 1 1 1\nWIDTH {0}\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA binary\n",
      points);
}
}  // namespace

void writePcd(const std::filesystem::path& path, const PointCloud& points)
{
  std::vector<std::uint8_t> bytes(points.size() * kPointSize);
  std::size_t offset = 0;
  const auto put = [&](auto value)
  {
    store(bytes, offset, value);
    offset += sizeof value;
  };
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    put(points.x[i]);
    put(points.y[i]);
    put(points.z[i]);
    put(static_cast<float>(points.intensity[i]));
    put(static_cast<float>(seconds(Duration{points.t[i]})));
    put(static_cast<std::uint16_t>(points.ring[i]));
    put(points.column[i]);
    put(points.sensor_id[i]);
  }
  writeAtomically(path,
                  [&](std::ostream& file)
                  {
                    file << headerOf(points.size());
                    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
                  });
}
}  // namespace scanloom
