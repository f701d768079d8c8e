#include "estimation/ndt/internal/RingSpread.h"

#include "base/core/forAll.h"

#include <algorithm>

namespace scanloom
{
void widenAcrossRings(std::vector<Bin>& bins, std::int64_t cell_quanta, const Eigen::Vector3d& viewpoint,
                      const Rings& rings)
{
  constexpr std::size_t kGrain = 256;
  const double edge = edgeOf(cell_quanta);
  forAll(bins.size(), kGrain,
         [&](std::size_t i)
         {
           if (bins[i].moments.n < 2) return;
           const MeanAndCovariance seen = meanAndCovariance(bins[i], edge);
           const Eigen::Vector3d view = seen.mean - viewpoint;
           const Eigen::Vector3d across = (view.squaredNorm() * rings.axis - view.dot(rings.axis) * view).normalized();
           const double width = std::min(edge, rings.spacing * view.norm());
           const double missing = width * width / 12 - across.dot(seen.covariance * across);
           if (missing > 0) widenBy(missing, across, bins[i]);
         });
}
}  // namespace scanloom
