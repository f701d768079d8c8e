#include "estimation/graph/ImuFactor.h"

#include "estimation/graph/internal/Whitening.h"

namespace scanloom
{
namespace
{
using Matrix3d = Eigen::Matrix3d;
using Vector3d = Eigen::Vector3d;

/**
 * The covariance of a motion of one step has rank 6, because its position follows from its velocity. A micrometre is
 * below the error of interpolating the readings linearly, and makes the rank full.
 */
constexpr double kPositionFloor = 1e-6;  // m

Matrix15d rootOf(const Preintegration& motion, const ImuNoise& noise)
{
  Matrix9d covariance = motion.covariance;
  covariance.diagonal().tail<3>().array() += kPositionFloor * kPositionFloor;
  const double root_duration = std::sqrt(motion.duration());

  Matrix15d root = Matrix15d::Zero();
  root.topLeftCorner<9, 9>() = rootOfInverse(covariance);
  root.diagonal().segment<3>(9).setConstant(1 / (noise.gyro_bias_walk_deg * M_PI / 180 * root_duration));
  root.diagonal().tail<3>().setConstant(1 / (noise.accel_bias_walk * root_duration));
  return root;
}

/** The motion between the two states minus the preintegrated Delta R, v, p: eq. (45). */
struct Residual
{
  Residual(const NavState& from, const NavState& to, const Preintegration& motion)
    : delta(deltaAt(motion, from.bias)), to_local(from.map_T_imu.rotation.conjugate().toRotationMatrix())
  {
    const double dt = motion.duration();
    turn = to_local * to.map_T_imu.rotation.toRotationMatrix();
    velocity_gain = to_local * (to.velocity - from.velocity - gravityInMap() * dt);
    displacement = to_local * (to.map_T_imu.translation - from.map_T_imu.translation - from.velocity * dt -
                               0.5 * dt * dt * gravityInMap());
    const Eigen::Quaterniond error =
        delta.rotation.conjugate() * from.map_T_imu.rotation.conjugate() * to.map_T_imu.rotation;
    value << logSo3(error), velocity_gain - delta.velocity, displacement - delta.position,
        to.bias.gyro - from.bias.gyro, to.bias.accel - from.bias.accel;
  }

  ImuDelta delta;
  Matrix3d to_local, turn;
  Vector3d velocity_gain, displacement;
  Vector15d value;  // rotation, velocity, position, gyro bias, accelerometer bias
};

/** Jacobians by the tangents of boxPlus(NavState): pose and motion of both states. */
struct Jacobians
{
  Eigen::Matrix<double, 15, 6> by_from_pose = Eigen::Matrix<double, 15, 6>::Zero();
  Eigen::Matrix<double, 15, 9> by_from_motion = Eigen::Matrix<double, 15, 9>::Zero();
  Eigen::Matrix<double, 15, 6> by_to_pose = Eigen::Matrix<double, 15, 6>::Zero();
  Eigen::Matrix<double, 15, 9> by_to_motion = Eigen::Matrix<double, 15, 9>::Zero();
};

Jacobians jacobiansOf(const Residual& r, const NavState& from, const Preintegration& motion)
{
  const Vector3d rotation_error = r.value.head<3>();
  const Matrix3d by_right = rightJacobianInverseSo3(rotation_error);
  const Vector3d bias_turn = motion.rotation_by_gyro * (from.bias.gyro - motion.bias.gyro);

  Jacobians j;
  j.by_from_pose.block<3, 3>(0, 3) = -by_right * r.turn.transpose();
  j.by_from_pose.block<3, 3>(3, 3) = skew(r.velocity_gain);
  j.by_from_pose.block<3, 3>(6, 0) = -Matrix3d::Identity();
  j.by_from_pose.block<3, 3>(6, 3) = skew(r.displacement);

  j.by_from_motion.block<3, 3>(3, 0) = -r.to_local;
  j.by_from_motion.block<3, 3>(6, 0) = -r.to_local * motion.duration();
  j.by_from_motion.block<3, 3>(0, 3) = -by_right * expSo3(rotation_error).toRotationMatrix().transpose() *
                                       rightJacobianSo3(bias_turn) * motion.rotation_by_gyro;
  j.by_from_motion.block<3, 3>(3, 3) = -motion.velocity_by_gyro;
  j.by_from_motion.block<3, 3>(6, 3) = -motion.position_by_gyro;
  j.by_from_motion.block<3, 3>(3, 6) = -motion.velocity_by_accel;
  j.by_from_motion.block<3, 3>(6, 6) = -motion.position_by_accel;
  j.by_from_motion.bottomRightCorner<6, 6>() = -Matrix6d::Identity();

  j.by_to_pose.block<3, 3>(0, 3) = by_right;
  j.by_to_pose.block<3, 3>(6, 0) = r.turn;
  j.by_to_motion.block<3, 3>(3, 0) = r.to_local;
  j.by_to_motion.bottomRightCorner<6, 6>() = Matrix6d::Identity();
  return j;
}

void writeMotionJacobian(const Eigen::Matrix<double, 15, 9>& by_motion, double* out)
{
  if (out) Eigen::Map<Eigen::Matrix<double, 15, 9, Eigen::RowMajor>>{out} = by_motion;
}
}  // namespace

ImuFactor::ImuFactor(const Preintegration& motion, const ImuNoise& noise)
  : motion_(motion), root_(rootOf(motion, noise))
{
}

bool ImuFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const
{
  const NavState from = stateOf(parameters[0], parameters[1], motion_.from);
  const NavState to = stateOf(parameters[2], parameters[3], motion_.to);
  const Residual residual(from, to, motion_);
  Eigen::Map<Vector15d>{residuals} = root_ * residual.value;
  if (!jacobians) return true;

  const Jacobians j = jacobiansOf(residual, from, motion_);
  writePoseJacobian<15>(root_ * j.by_from_pose, from.map_T_imu, jacobians[0]);
  writeMotionJacobian(root_ * j.by_from_motion, jacobians[1]);
  writePoseJacobian<15>(root_ * j.by_to_pose, to.map_T_imu, jacobians[2]);
  writeMotionJacobian(root_ * j.by_to_motion, jacobians[3]);
  return true;
}
}  // namespace scanloom
