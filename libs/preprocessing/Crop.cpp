#include "preprocessing/Crop.h"

#include <cmath>

namespace scanloom
{
Scan cropOut(Scan scan, const CropOptions& o)
{
  const PointCloud& points = scan.points;
  const auto within = [](float v, double low, double high) { return v >= low && v <= high; };
  const auto wanted = [&](std::size_t i)
  {
    const float x = points.x[i], y = points.y[i], z = points.z[i];
    const double range = 1e-3 * points.range[i];
    const bool machine = within(x, o.min_x, o.max_x) && within(y, o.min_y, o.max_y) && within(z, o.min_z, o.max_z);
    const bool finite = std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
    return finite && !machine && (range == 0 || (range >= o.min_range && range <= o.max_range));
  };

  std::vector<std::uint8_t> keep(points.size());
  std::uint32_t kept = 0;
  for (Column& column : scan.columns)
  {
    const std::uint32_t first = kept;
    for (std::size_t i = column.first_point; i < std::size_t{column.first_point} + column.count; ++i)
      kept += keep[i] = wanted(i);
    column.first_point = first;
    column.count = static_cast<std::uint16_t>(kept - first);
  }
  scan.points.keep(keep);
  return scan;
}
}  // namespace scanloom
