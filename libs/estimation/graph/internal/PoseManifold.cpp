#include "estimation/graph/internal/PoseManifold.h"

namespace scanloom
{
PoseBlock blockOf(const Rigid& pose)
{
  PoseBlock block;
  block << pose.translation, pose.rotation.coeffs();
  return block;
}

Rigid poseOf(const double* block)
{
  return {Eigen::Map<const Eigen::Quaterniond>(block + 3), Eigen::Map<const Eigen::Vector3d>(block)};
}

bool PoseManifold::Plus(const double* x, const double* step, double* x_plus_step) const
{
  Eigen::Map<PoseBlock> result(x_plus_step);
  result = blockOf(boxPlus(poseOf(x), Vector6d(Eigen::Map<const Vector6d>(step))));
  return result.allFinite();
}

bool PoseManifold::PlusJacobian(const double* x, double* jacobian) const
{
  Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>>{jacobian} = plusJacobian(poseOf(x));
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const
{
  Eigen::Map<Vector6d>{y_minus_x} = boxMinus(poseOf(y), poseOf(x));
  return true;
}

bool PoseManifold::MinusJacobian(const double* x, double* jacobian) const
{
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>>{jacobian} = minusJacobian(poseOf(x));
  return true;
}

Eigen::Matrix<double, 7, 6> PoseManifold::plusJacobian(const Rigid& pose)
{
  // q exp(v) ~ q + q (v/2, 0): the quaternion product, written out
  const Eigen::Quaterniond& q = pose.rotation;
  Eigen::Matrix<double, 7, 6> j = Eigen::Matrix<double, 7, 6>::Zero();
  j.topLeftCorner<3, 3>() = q.toRotationMatrix();
  j.block<3, 3>(3, 3) = 0.5 * (q.w() * Eigen::Matrix3d::Identity() + skew(q.vec()));
  j.block<1, 3>(6, 3) = -0.5 * q.vec().transpose();
  return j;
}

Eigen::Matrix<double, 6, 7> PoseManifold::minusJacobian(const Rigid& pose)
{
  // The four columns of the quaternion's part are orthonormal but for the factor 1/2.
  Eigen::Matrix<double, 6, 7> j = Eigen::Matrix<double, 6, 7>::Zero();
  j.topLeftCorner<3, 3>() = pose.rotation.conjugate().toRotationMatrix();
  j.bottomRightCorner<3, 4>() = 4 * plusJacobian(pose).bottomRightCorner<4, 3>().transpose();
  return j;
}

Matrix6d boxMinusByStep(const Rigid& to, const Rigid& from)
{
  const Eigen::Quaterniond between = from.rotation.conjugate() * to.rotation;
  Matrix6d j = Matrix6d::Zero();
  j.topLeftCorner<3, 3>() = between.toRotationMatrix();
  j.bottomRightCorner<3, 3>() = rightJacobianInverseSo3(logSo3(between));
  return j;
}
}  // namespace scanloom
