#include "estimation/ndt/internal/RingSpread.h"

#include "base/core/Decompositions.h"
#include "estimation/ndt/FittedConstants.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
/** Raises the variance along a unit vector to that of an even spread over `width`. */
Bin spread(const Bin& bin, const Eigen::Matrix3d& covariance, double width, const Eigen::Vector3d& along)
{
  const double missing = width * width / 12 - along.dot(covariance * along);
  return missing > 0 ? widened(bin, missing, along) : bin;
}
}  // namespace

SurfaceOfBlock surfaceOf(const Bin* first, const Bin* last, double edge)
{
  const Eigen::Vector3d corner = cornerOf(*first, edge);
  Moments sum;
  for (const Bin* bin = first; bin != last; ++bin)
  {
    const Eigen::Vector3d from = (cornerOf(*bin, edge) - corner) / Moments::kQuantum;
    sum += bin->moments.about({std::llround(from.x()), std::llround(from.y()), std::llround(from.z())});
  }
  if (sum.n < 3) return {};
  const Eigensystem3 of_points = eigensystem3(meanAndCovariance(sum, corner).covariance);
  const Eigen::Array3d deviation = of_points.values.array().max(0).sqrt();
  const bool is_flat = deviation[0] < fitted::kFlatness * deviation[1],
             is_line = deviation[1] < fitted::kFlatness * deviation[2];
  if (is_line) return {std::nullopt, deviation[2] > edge / std::sqrt(12)};
  if (is_flat) return {Eigen::Vector3d(of_points.vectors.col(0)), false};
  return {};
}

Bin widenedAcrossRings(const Bin& bin, const MeanAndCovariance& seen, const Sight& sight, const Rings& rings,
                       const SurfaceOfBlock& surface)
{
  const Eigen::Vector3d view = seen.mean - sight.viewpoint;
  const Eigen::Vector3d across = (view.squaredNorm() * rings.axis - view.dot(rings.axis) * view).normalized();
  const double gap = rings.spacing * view.norm();
  if (surface.is_line)
  {
    const double missing = gap * gap / 12 - across.dot(seen.covariance * across);
    if (missing <= 0) return bin;
    return spread(spread(bin, seen.covariance, std::min(sight.edge, gap), across), seen.covariance, sight.edge,
                  view.normalized());
  }
  Eigen::Vector3d along = across;
  if (surface.normal)
  {
    const Eigen::Vector3d in_surface = view.cross(across).cross(*surface.normal);
    if (in_surface.norm() > 0.1 * view.norm()) along = in_surface.normalized();
  }
  const double facing = std::abs(along.dot(across));
  return spread(bin, seen.covariance, std::min(sight.edge, gap / std::max(facing, 1e-9)), along);
}
}  // namespace scanloom
