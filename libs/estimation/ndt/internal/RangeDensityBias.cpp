#include "estimation/ndt/internal/RangeDensityBias.h"

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr double kExtinction = 0.6;  // 1/m, along a ray through foliage
constexpr double kShare = 0.5;       // of the shift by both: see the header
constexpr double kNearest = 1;       // m: nearer, 1 / r^2 is no exponential across a cell
}  // namespace

Eigen::Vector3d rangeDensityShift(const MeanAndCovariance& seen, const Sight& sight)
{
  const Eigen::Vector3d view = seen.mean - sight.viewpoint;
  const double range = std::max(kNearest, view.norm());
  return kShare * (kExtinction + 2 / range) / range * (seen.covariance * view);
}
}  // namespace scanloom
