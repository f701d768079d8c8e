#include "estimation/graph/internal/RelativePoseFactor.h"

#include "estimation/graph/PosePriorFactor.h"
#include "estimation/graph/internal/Whitening.h"

namespace scanloom
{
namespace
{
/** Derivative of reference_T_body, in its own tangent, by a step of the reference: minus the adjoint of its inverse. */
Matrix6d byStepOfReference(const Rigid& reference_T_body) { return -bodyStepByImuStep(reference_T_body); }
}  // namespace

RelativePoseFactor::RelativePoseFactor(const Rigid& reference_T_body, const Matrix6d& information,
                                       const Rigid& body_T_imu)
  : reference_T_body_(reference_T_body), imu_T_body_(body_T_imu.inverse()), root_(rootOfInformation(information))
{
}

bool RelativePoseFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const
{
  const Rigid map_T_reference_imu = poseOf(parameters[0]);
  const Rigid map_T_imu = poseOf(parameters[1]);
  const Rigid reference_T_body = (map_T_reference_imu * imu_T_body_).inverse() * (map_T_imu * imu_T_body_);
  Eigen::Map<Vector6d>{residuals} = root_ * boxMinus(reference_T_body, reference_T_body_);
  if (!jacobians) return true;

  const Matrix6d by_body = root_ * boxMinusByStep(reference_T_body, reference_T_body_);
  const Matrix6d body_by_imu = bodyStepByImuStep(imu_T_body_);
  writePoseJacobian<6>(by_body * byStepOfReference(reference_T_body) * body_by_imu, map_T_reference_imu, jacobians[0]);
  writePoseJacobian<6>(by_body * body_by_imu, map_T_imu, jacobians[1]);
  return true;
}
}  // namespace scanloom
