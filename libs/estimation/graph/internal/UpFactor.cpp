#include "estimation/graph/internal/UpFactor.h"

namespace scanloom
{
bool UpFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const
{
  const Rigid map_T_body = poseOf(parameters[0]);
  const Eigen::Vector3d up = upInBody(map_T_body);
  Eigen::Map<Eigen::Vector3d>{residuals} = up.cross(body_up_) / sigma_;
  if (!jacobians) return true;

  // A turn w of the body moves its up by up x w.
  Eigen::Matrix<double, 3, 6> by_step = Eigen::Matrix<double, 3, 6>::Zero();
  by_step.rightCols<3>() = -skew(body_up_) * skew(up) / sigma_;
  writePoseJacobian<3>(by_step, map_T_body, jacobians[0]);
  return true;
}
}  // namespace scanloom
