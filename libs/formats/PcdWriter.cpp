#include "formats/PcdWriter.h"

#include "core/AtomicFile.h"
#include "core/Time.h"
#include "formats/LittleEndianBuffer.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace scanloom
{
namespace
{
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
  LittleEndianBuffer buffer;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (const float coordinate : {points.x[i], points.y[i], points.z[i]}) buffer.put(coordinate);
    buffer.put(static_cast<float>(points.intensity[i]));
    buffer.put(static_cast<float>(seconds(Duration{points.t[i]})));
    buffer.put(static_cast<std::uint16_t>(points.ring[i]));
    buffer.put(points.column[i]);
    buffer.put(points.sensor_id[i]);
  }
  writeAtomically(path,
                  [&](std::ostream& file)
                  {
                    file << headerOf(points.size());
                    buffer.writeTo(file);
                  });
}
}  // namespace scanloom
