#include "slam/WindowStart.h"

#include "graph/PosePriorFactor.h"
#include "imu/BiasOfReplacement.h"
#include "imu/ImuBuffer.h"

#include <cmath>
#include <optional>

namespace scanloom
{
namespace
{
Matrix15d covarianceOf(const ImuChange& change, const Matrix15d& known, const Rigid& old_T_new, bool biases_known)
{
  constexpr double kTilt = 0.005, kVelocity = 0.3;            // rad, m/s
  constexpr double kGyroBias = 0.02, kKnownGyroBias = 0.001;  // rad/s
  constexpr double kKnownAccelBias = 0.02;                    // m/s2, by the lever's accelerations
  const Eigen::Matrix3d new_R_old = old_T_new.rotation.conjugate().toRotationMatrix();
  const Matrix6d step = bodyStepByImuStep(old_T_new);
  Matrix15d covariance = Matrix15d::Zero();
  covariance.topLeftCorner<6, 6>() = step * known.topLeftCorner<6, 6>() * step.transpose();
  covariance.block<3, 3>(6, 6) = known.block<3, 3>(6, 6);
  covariance.diagonal().segment<3>(3).array() += kTilt * kTilt;
  covariance.diagonal().segment<3>(6).array() += kVelocity * kVelocity;
  covariance.diagonal().segment<3>(9).setConstant(std::pow(biases_known ? kKnownGyroBias : kGyroBias, 2));
  covariance.diagonal().segment<3>(12).setConstant(std::pow(change.imu.noise.accel_bias_sigma, 2));
  if (biases_known)
    covariance.bottomRightCorner<3, 3>() = new_R_old * known.bottomRightCorner<3, 3>() * new_R_old.transpose() +
                                           std::pow(kKnownAccelBias, 2) * Eigen::Matrix3d::Identity();
  return covariance;
}

Eigen::Vector3d rateAt(Timestamp stamp, const std::vector<ImuSample>& samples, const ImuBias& bias)
{
  const std::vector<ImuSample> then = ImuBuffer(samples).between(stamp, stamp + 1ms);
  return then.empty() ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(then.front().gyro - bias.gyro);
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
  return {state, covarianceOf(change, newest.covariance, old_T_new, bias.has_value())};
}

NavEstimate foundAt(const Rigid& map_T_body, const Matrix6d& body_covariance, const NavEstimate& newest,
                    const ImuBias& bias, const PlacedImu& imu)
{
  constexpr double kVelocity = 1;                              // m/s
  const double level = imu.noise.accel_bias_sigma / kGravity;  // rad
  const Eigen::Matrix3d body_R_map = map_T_body.rotation.conjugate().toRotationMatrix();
  Matrix6d of_body = body_covariance;
  of_body.bottomRightCorner<3, 3>() += level * level * body_R_map.leftCols<2>() * body_R_map.leftCols<2>().transpose();

  const Matrix6d imu_by_body = bodyStepByImuStep(imu.body_T_imu);
  NavEstimate found = newest;
  found.state.map_T_imu = map_T_body * imu.body_T_imu;
  found.state.velocity.setZero();
  found.state.bias = bias;
  found.covariance.topRows<9>().setZero();
  found.covariance.leftCols<9>().setZero();
  found.covariance.topLeftCorner<6, 6>() = imu_by_body * of_body * imu_by_body.transpose();
  found.covariance.diagonal().segment<3>(6).setConstant(kVelocity * kVelocity);
  return found;
}
}  // namespace scanloom
