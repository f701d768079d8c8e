#include "base/formats/KittiWriter.h"

#include "base/core/OutputFile.h"
#include "base/formats/LittleEndianBuffer.h"

namespace scanloom
{
void writeKittiScan(const std::filesystem::path& path, const PointCloud& points)
{
  constexpr float kFullIntensity = 255.f;
  LittleEndianBuffer buffer;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (const float coordinate : {points.x[i], points.y[i], points.z[i]}) buffer.put(coordinate);
    buffer.put(static_cast<float>(points.intensity[i]) / kFullIntensity);
  }
  writeAtomically(path, [&](std::ostream& file) { buffer.writeTo(file); });
}
}  // namespace scanloom
