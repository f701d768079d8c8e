#include "estimation/slam/internal/SmootherWindow.h"

#include "base/core/Decompositions.h"

namespace scanloom
{
Rigid SmootherWindow::map_T_local() const
{
  return smoother.hasAnchor() ? smoother.anchorBody() * local_T_anchor.inverse() : map_T_local_without_anchor;
}

void SmootherWindow::anchorAt(const Rigid& local_T_body)
{
  smoother.anchorNewest();
  local_T_anchor = local_T_body;
}

SmootherWindow windowFrom(const NavEstimate& start, const MountedImu& imu, const SmootherOptions& options)
{
  // Rounding can cost a covariance its positive eigenvalues where it spans kilometres and millimetres.
  const Matrix15d covariance = isPositiveDefinite(start.covariance)
                                   ? start.covariance
                                   : Matrix15d(start.covariance.diagonal().cwiseAbs().asDiagonal());
  return {{start.state, covariance, imu.body_T_imu, imu.noise, options}, imu.assumed};
}
}  // namespace scanloom
