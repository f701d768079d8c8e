#include "estimation/ndt/internal/FadingDensity.h"

#include "base/core/forAll.h"

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr double kExtinction = 0.6;  // 1/m, along a ray through foliage
constexpr double kShare = 0.5;       // of the shift by both: see the header
constexpr double kNearest = 1;       // m: nearer, 1 / r^2 is no exponential across a cell
}  // namespace

void undoFading(std::vector<Bin>& bins, std::int64_t cell_quanta, const Eigen::Vector3d& viewpoint, int least_points)
{
  constexpr std::size_t kGrain = 256;
  const double edge = edgeOf(cell_quanta);
  forAll(bins.size(), kGrain,
         [&](std::size_t i)
         {
           if (bins[i].moments.n < least_points) return;
           const MeanAndCovariance seen = meanAndCovariance(bins[i], edge);
           const Eigen::Vector3d view = seen.mean - viewpoint;
           const double range = std::max(kNearest, view.norm());
           moveBy(kShare * (kExtinction + 2 / range) / range * (seen.covariance * view), bins[i]);
         });
}
}  // namespace scanloom
