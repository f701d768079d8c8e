#include "output/KittiScan.h"

#include "config/AtomicFile.h"
#include "core/Bytes.h"

#include <ostream>
#include <vector>

namespace scanloom
{
void writeKittiScan(const std::filesystem::path& path, const PointCloud& points)
{
  constexpr float kFullIntensity = 255.f;
  std::vector<std::uint8_t> bytes(points.size() * 4 * sizeof(float));
  std::size_t offset = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const float value :
         {points.x[i], points.y[i], points.z[i], static_cast<float>(points.intensity[i]) / kFullIntensity})
    {
      store(bytes, offset, value);
      offset += sizeof value;
    }
  writeAtomically(
      path, [&](std::ostream& file)
      { file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())); });
}
}  // namespace scanloom
