#include "estimation/graph/PosePriorFactor.h"

#include "base/core/Decompositions.h"
#include "estimation/graph/internal/Whitening.h"

namespace scanloom
{
Matrix6d bodyStepByImuStep(const Rigid& imu_T_body)
{
  const Eigen::Matrix3d body_R_imu = imu_T_body.rotation.conjugate().toRotationMatrix();
  Matrix6d j = Matrix6d::Zero();
  j.topLeftCorner<3, 3>() = body_R_imu;
  j.topRightCorner<3, 3>() = -body_R_imu * skew(imu_T_body.translation);
  j.bottomRightCorner<3, 3>() = body_R_imu;
  return j;
}

PosePriorFactor::PosePriorFactor(const Rigid& map_T_body, const Matrix6d& information, const Rigid& body_T_imu)
  : map_T_body_(map_T_body), imu_T_body_(body_T_imu.inverse()), root_(rootOfInformation(information))
{
}

bool PosePriorFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const
{
  const Rigid map_T_imu = poseOf(parameters[0]);
  const Rigid map_T_body = map_T_imu * imu_T_body_;
  Eigen::Map<Vector6d>{residuals} = root_ * boxMinus(map_T_body, map_T_body_);
  if (jacobians)
    writePoseJacobian<6>(root_ * boxMinusByStep(map_T_body, map_T_body_) * bodyStepByImuStep(imu_T_body_), map_T_imu,
                         jacobians[0]);
  return true;
}

Matrix6d movedTo(const Rigid& a_T_b, const Matrix6d& covariance)
{
  return congruent(covariance, bodyStepByImuStep(a_T_b).transpose());
}
}  // namespace scanloom
