#include "batching/ScanMeasures.h"

#include <algorithm>

namespace scanloom
{
Duration spanOf(const Scan& scan)
{
  if (scan.columns.empty()) return Duration{0};
  const auto [oldest, newest] = std::minmax_element(scan.columns.begin(), scan.columns.end(),
                                                    [](const Column& a, const Column& b) { return a.stamp < b.stamp; });
  return newest->stamp - oldest->stamp;
}

double extentAlong(const Eigen::Vector3d& direction, const PointCloud& cloud, const std::vector<std::size_t>& points)
{
  if (points.empty()) return 0;
  const auto along = [&](std::size_t i) { return direction.dot(cloud.position(i).cast<double>()); };
  const auto [least, most] = std::minmax_element(points.begin(), points.end(),
                                                 [&](std::size_t a, std::size_t b) { return along(a) < along(b); });
  return along(*most) - along(*least);
}
}  // namespace scanloom
