#include "estimation/graph/internal/DriftingMotionFactor.h"

#include "estimation/graph/PosePriorFactor.h"
#include "estimation/graph/internal/Whitening.h"

namespace scanloom
{
DriftingMotionFactor::DriftingMotionFactor(const Rigid& from_T_to, const Eigen::Vector3d& from_up,
                                           const Matrix6d& information)
  : from_T_to_(from_T_to), root_(rootOfInformation(information))
{
  by_shares_ << from_T_to.translation, from_T_to.translation.norm() * from_up;
}

bool DriftingMotionFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const
{
  const Rigid map_T_from = poseOf(parameters[0]), map_T_to = poseOf(parameters[1]);
  Rigid measured = from_T_to_;
  measured.translation += by_shares_ * Eigen::Map<const Eigen::Vector2d>(parameters[2]);
  const Rigid from_T_to = map_T_from.inverse() * map_T_to;
  Eigen::Map<Vector6d>{residuals} = root_ * boxMinus(from_T_to, measured);
  if (!jacobians) return true;

  const Matrix6d by_step = root_ * boxMinusByStep(from_T_to, measured);
  writePoseJacobian<6>(-by_step * bodyStepByImuStep(from_T_to), map_T_from, jacobians[0]);
  writePoseJacobian<6>(by_step, map_T_to, jacobians[1]);
  if (!jacobians[2]) return true;
  Eigen::Matrix<double, 6, 2> by_shares = Eigen::Matrix<double, 6, 2>::Zero();
  by_shares.topRows<3>() = -(measured.rotation.conjugate().toRotationMatrix() * by_shares_);
  Eigen::Map<Eigen::Matrix<double, 6, 2, Eigen::RowMajor>>{jacobians[2]} = root_ * by_shares;
  return true;
}
}  // namespace scanloom
