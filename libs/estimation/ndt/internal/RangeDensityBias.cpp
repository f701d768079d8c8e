#include "estimation/ndt/internal/RangeDensityBias.h"

#include "estimation/ndt/FittedConstants.h"

#include <algorithm>

namespace scanloom
{
Eigen::Vector3d rangeDensityShift(const MeanAndCovariance& seen, const Sight& sight)
{
  const Eigen::Vector3d view = seen.mean - sight.viewpoint;
  const double range = std::max(1.0, view.norm());  // m: nearer, 1 / r^2 is no exponential across a cell
  return fitted::kDensityShare * (fitted::kExtinction + 2 / range) / range * (seen.covariance * view);
}
}  // namespace scanloom
