#include "estimation/slam/internal/SmootherReset.h"

#include "estimation/graph/PosePriorFactor.h"
#include "estimation/imu/ImuBuffer.h"
#include "estimation/ndt/FittedConstants.h"
#include "estimation/slam/internal/BiasOfReplacement.h"

#include <cmath>
#include <optional>

namespace scanloom
{
namespace
{
/** Derivatives of the new IMU's state by that of the one before; its biases are other ones where they are not known. */
Matrix15d byStateBefore(const Rigid& old_T_new, bool biases_known)
{
  Matrix15d j = Matrix15d::Zero();
  j.topLeftCorner<6, 6>() = bodyStepByImuStep(old_T_new);
  j.block<3, 3>(6, 6).setIdentity();
  if (!biases_known) return j;
  const Eigen::Matrix3d new_R_old = old_T_new.rotation.conjugate().toRotationMatrix();
  j.block<3, 3>(9, 9) = j.block<3, 3>(12, 12) = new_R_old;
  return j;
}

/** Tilt and bias of the one before are wrong together, and so are they of the new one. */
Matrix15d covarianceOf(const ImuChange& change, const Matrix15d& known, const Rigid& old_T_new, bool biases_known)
{
  const double gyro_bias = biases_known ? fitted::kGyroBiasKnown : fitted::kGyroBiasUnknown;
  const double accel_bias = biases_known ? fitted::kAccelBiasKnown : change.imu.noise.accel_bias_sigma;
  const Matrix15d j = byStateBefore(old_T_new, biases_known);
  Matrix15d covariance = j * known * j.transpose();
  covariance.diagonal().segment<3>(3).array() += fitted::kTiltOfChange * fitted::kTiltOfChange;
  covariance.diagonal().segment<3>(6).array() += fitted::kVelocityOfChange * fitted::kVelocityOfChange;
  covariance.diagonal().segment<3>(9).array() += gyro_bias * gyro_bias;
  covariance.diagonal().segment<3>(12).array() += accel_bias * accel_bias;
  return covariance;
}

/**
 * The accelerometer's bias that follows from the IMU before is more than this one may have: the difference is tilt,
 * which is measured where the better accelerometer takes over.
 */
NavEstimate updatedByBiasPrior(const NavEstimate& estimate, double accel_bias_sigma)
{
  const Matrix15d& p = estimate.covariance;
  const Eigen::Matrix3d innovation =
      p.bottomRightCorner<3, 3>() + std::pow(accel_bias_sigma, 2) * Eigen::Matrix3d::Identity();
  const Eigen::Matrix<double, 15, 3> gain = p.rightCols<3>() * innovation.inverse();
  NavEstimate corrected;
  corrected.state = boxPlus(estimate.state, Vector15d(-gain * estimate.state.bias.accel));
  const Matrix15d covariance = p - gain * p.bottomRows<3>();
  corrected.covariance = 0.5 * (covariance + covariance.transpose());
  return corrected;
}

Eigen::Vector3d rateAt(Timestamp stamp, const std::vector<ImuSample>& samples, const ImuBias& bias)
{
  const std::vector<ImuSample> then = ImuBuffer(samples).between(stamp, stamp + 1ms);
  return then.empty() ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(then.front().gyro - bias.gyro);
}

/** Covariance of a body's pose whose roll and pitch have this deviation (rad), in its frame. */
Matrix6d tiltCovariance(const Rigid& map_T_body, double sigma)
{
  const Eigen::Matrix3d body_R_map = map_T_body.rotation.conjugate().toRotationMatrix();
  Matrix6d covariance = Matrix6d::Zero();
  covariance.bottomRightCorner<3, 3>() =
      sigma * sigma * body_R_map.leftCols<2>() * body_R_map.leftCols<2>().transpose();
  return covariance;
}

/** The newest state, with another pose of the body, at rest for all that is known. */
NavEstimate withUnknownVelocity(const Rigid& map_T_body, const Matrix6d& body_covariance, NavEstimate newest,
                                const MountedImu& imu)
{
  newest.state.map_T_imu = map_T_body * imu.body_T_imu;
  newest.state.velocity.setZero();
  newest.covariance.topRows<9>().setZero();
  newest.covariance.leftCols<9>().setZero();
  newest.covariance.topLeftCorner<6, 6>() = movedTo(imu.body_T_imu, body_covariance);
  newest.covariance.diagonal().segment<3>(6).setConstant(fitted::kSpeedAtRest * fitted::kSpeedAtRest);
  return newest;
}
}  // namespace

NavEstimate continuedBy(const ImuChange& change, const NavEstimate& newest, const Rigid& body_T_imu_before)
{
  const Rigid old_T_new = body_T_imu_before.inverse() * change.imu.body_T_imu;
  const auto bias = biasOfReplacement(change.previous, newest.state.bias, change.samples, old_T_new);
  NavState state = newest.state;
  state.bias = bias.value_or(ImuBias{});
  state.map_T_imu = state.map_T_imu * old_T_new;
  const Eigen::Vector3d lever = old_T_new.rotation.conjugate() * old_T_new.translation;
  state.velocity += state.map_T_imu.rotation * rateAt(state.stamp, change.samples, state.bias).cross(lever);
  const NavEstimate continued{state, covarianceOf(change, newest.covariance, old_T_new, bias.has_value())};
  return bias ? updatedByBiasPrior(continued, change.imu.noise.accel_bias_sigma) : continued;
}

NavEstimate foundAt(const Rigid& map_T_body, const Matrix6d& body_covariance, const NavEstimate& newest,
                    const ImuBias& bias, const MountedImu& imu)
{
  const Matrix6d tilt = tiltCovariance(map_T_body, imu.noise.accel_bias_sigma / kGravity);
  NavEstimate found = withUnknownVelocity(map_T_body, body_covariance + tilt, newest, imu);
  found.state.bias = bias;
  return found;
}

NavEstimate inFrame(const Rigid& map_T_drive, const Matrix6d& body_covariance, const NavEstimate& newest,
                    const MountedImu& imu)
{
  const Eigen::Matrix3d map_R_drive = map_T_drive.rotation.toRotationMatrix();
  NavEstimate moved = newest;
  moved.state.map_T_imu = map_T_drive * newest.state.map_T_imu;
  moved.state.velocity = map_R_drive * newest.state.velocity;
  const Matrix6d tilt =
      tiltCovariance(moved.state.map_T_imu * imu.body_T_imu.inverse(), imu.noise.accel_bias_sigma / kGravity);
  moved.covariance.setZero();
  moved.covariance.topLeftCorner<6, 6>() = movedTo(imu.body_T_imu, body_covariance + tilt);
  moved.covariance.block<3, 3>(6, 6) = map_R_drive * newest.covariance.block<3, 3>(6, 6) * map_R_drive.transpose();
  moved.covariance.bottomRightCorner<6, 6>() = newest.covariance.bottomRightCorner<6, 6>();
  return moved;
}

bool knowsVelocity(const NavEstimate& estimate)
{
  return estimate.covariance.diagonal().segment<3>(6).maxCoeff() < fitted::kSpeedAtRest * fitted::kSpeedAtRest;
}

NavEstimate atRest(const Rigid& map_T_body, double tilt_sigma, const NavEstimate& newest, const MountedImu& imu)
{
  const Matrix6d of_imu = newest.covariance.topLeftCorner<6, 6>();
  const Matrix6d of_body = movedTo(imu.body_T_imu.inverse(), of_imu) + tiltCovariance(map_T_body, tilt_sigma);
  return withUnknownVelocity(map_T_body, of_body, newest, imu);
}
}  // namespace scanloom
