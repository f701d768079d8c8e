#pragma once
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

namespace scanloom
{
/** The share of `points` that have one of `others` within this angle, as seen from the sensor, and this distance. */
inline double shareFound(const std::vector<Eigen::Vector3f>& points, std::vector<Eigen::Vector3f> others,
                         double angle_deg, double distance_m = 1e-4)
{
  std::sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
  const auto isFound = [&](const Eigen::Vector3f& p)
  {
    const auto radius = static_cast<float>(distance_m + angle_deg * M_PI / 180 * p.norm());
    auto other = std::lower_bound(others.begin(), others.end(), p.x() - radius,
                                  [](const Eigen::Vector3f& o, float x) { return o.x() < x; });
    for (; other != others.end() && other->x() <= p.x() + radius; ++other)
      if ((*other - p).norm() <= radius) return true;
    return false;
  };
  return static_cast<double>(std::count_if(points.begin(), points.end(), isFound)) / static_cast<double>(points.size());
}
}  // namespace scanloom
