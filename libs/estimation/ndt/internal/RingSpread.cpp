#include "estimation/ndt/internal/RingSpread.h"

#include <algorithm>

namespace scanloom
{
Bin widenedAcrossRings(const Bin& bin, const MeanAndCovariance& seen, const Sight& sight, const Rings& rings)
{
  const Eigen::Vector3d view = seen.mean - sight.viewpoint;
  const Eigen::Vector3d across = (view.squaredNorm() * rings.axis - view.dot(rings.axis) * view).normalized();
  const double width = std::min(sight.edge, rings.spacing * view.norm());
  const double missing = width * width / 12 - across.dot(seen.covariance * across);
  return missing > 0 ? widened(bin, missing, across) : bin;
}
}  // namespace scanloom
