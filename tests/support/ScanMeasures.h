/** What the points of a scan span in time and space: to compare ways of batching. */
#pragma once
#include "input/batching/Scan.h"

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace scanloom
{
/** Stamp of the newest column minus that of the oldest; 0 for a scan without columns. */
inline Duration spanOf(const Scan& scan)
{
  if (scan.columns.empty()) return Duration{0};
  const auto [oldest, newest] = std::minmax_element(scan.columns.begin(), scan.columns.end(),
                                                    [](const Column& a, const Column& b) { return a.stamp < b.stamp; });
  return newest->stamp - oldest->stamp;
}

/**
 * How far these points of the cloud lie apart along a unit vector, m. For points of one object that moves along it,
 * what exceeds the object's own depth is smear: the paper's 28 cm (section 1.1). 0 for less than two points.
 */
inline double extentAlong(const Eigen::Vector3d& direction, const PointCloud& cloud,
                          const std::vector<std::size_t>& points)
{
  if (points.empty()) return 0;
  const auto along = [&](std::size_t i) { return direction.dot(cloud.position(i).cast<double>()); };
  const auto [least, most] = std::minmax_element(points.begin(), points.end(),
                                                 [&](std::size_t a, std::size_t b) { return along(a) < along(b); });
  return along(*most) - along(*least);
}
}  // namespace scanloom
