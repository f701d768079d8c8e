#include "estimation/graph/internal/PositionFactor.h"

#include "estimation/graph/internal/Whitening.h"

namespace scanloom
{
PositionFactor::PositionFactor(const Eigen::Vector3d& body_p_point, const Eigen::Vector3d& map_p_point,
                               const Eigen::Matrix3d& covariance)
  : body_p_point_(body_p_point), map_p_point_(map_p_point), root_(rootOfInverse(covariance))
{
}

bool PositionFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const
{
  const Rigid map_T_body = poseOf(parameters[0]);
  Eigen::Map<Eigen::Vector3d>{residuals} = root_ * (map_T_body * body_p_point_ - map_p_point_);
  if (!jacobians) return true;

  const Eigen::Matrix3d rotation = map_T_body.rotation.toRotationMatrix();
  Eigen::Matrix<double, 3, 6> by_step;
  by_step << rotation, -rotation * skew(body_p_point_);
  writePoseJacobian<3>(root_ * by_step, map_T_body, jacobians[0]);
  return true;
}
}  // namespace scanloom
