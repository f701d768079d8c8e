#include "estimation/imu/ImuInitialisation.h"

#include "base/core/Angle.h"
#include "estimation/imu/internal/ImuStep.h"
#include "estimation/imu/internal/SlowMotion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr double kMaxSlowAccel = 0.03;    // m/s2: largest change of the specific force at rest (root mean square of 3
                                          // axes, below 3 Hz): the engine's vibration is faster, motion is not
constexpr double kMaxSlowGyroDeg = 0.15;  // deg/s: largest change of the turn rate at rest, as above
constexpr double kMaxMeanGyroDeg = 2.0;   // deg/s: largest mean rate that can be a bias; a larger one is a turn
constexpr double kMaxGravityError = 0.5;  // m/s2: largest difference of the mean specific force from 9.80665

/** Standard deviations at the start. */
struct StartUncertainty
{
  double velocity;            // m/s
  double gyro_bias;           // rad/s
  double acceleration;        // m/s2, mean over the samples: cannot be separated from tilt
  double bias_along_gravity;  // m/s2
};
constexpr double kRestVelocity = 0.02;             // m/s, sway of a boom
constexpr double kGyroBiasWalk = 0.002 * kDegree;  // rad/s, over the standstill
constexpr double kLocalGravity = 0.03;             // m/s2, 9.78 at the equator to 9.83 at the poles
constexpr double kMovingVelocity = 2.0;            // m/s
constexpr double kMovingGyroBias = 1.0 * kDegree;  // rad/s, of a cheap sensor
constexpr double kMovingAcceleration = 0.5;        // m/s2
constexpr double kOriginSigma = 1e-3;              // m and rad: position and yaw define the map, they are not measured

bool isAtRest(const SlowMotion& m)
{
  // Shares of an engine's vibration that may look slow: an overtone near half the IMU's rate, or all of it, is sampled
  // as a slow motion.
  constexpr double kAliased = 0.08, kAliasedTurns = 0.04;
  return m.accel <= kMaxSlowAccel + kAliased * m.accel_all &&
         m.gyro <= kMaxSlowGyroDeg * kDegree + kAliasedTurns * m.gyro_all &&
         m.mean_gyro.norm() <= kMaxMeanGyroDeg * kDegree &&
         std::abs(m.mean_accel.norm() - kGravity) <= kMaxGravityError;
}

/** map_T_imu with the body at the origin, its yaw 0, and `up` (in the IMU's frame) along the map's z. */
Rigid levelled(const Eigen::Vector3d& up_in_imu, const Rigid& body_T_imu)
{
  const Eigen::Vector3d up = body_T_imu.rotation * up_in_imu;
  const double pitch = std::atan2(-up.x(), std::hypot(up.y(), up.z()));
  const double roll = std::atan2(up.y(), up.z());
  return Rigid::fromXyzYawPitchRoll(0, 0, 0, 0, pitch, roll) * body_T_imu;
}

Matrix15d covarianceOf(const Eigen::Vector3d& up, const Rigid& body_T_imu, double accel_bias_sigma,
                       const StartUncertainty& sigma)
{
  const auto square = [](double x) { return x * x; };
  const Eigen::Matrix3d along = up * up.transpose();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along;
  const Eigen::Matrix3d bias = square(accel_bias_sigma) * across + square(sigma.bias_along_gravity) * along;

  // An acceleration tilts `up` towards itself. The body is at the origin, so a tilt moves the IMU.
  const Eigen::Matrix3d tilt_by_force = skew(up) / kGravity;
  const Eigen::Matrix3d shift_by_tilt = -skew(body_T_imu.rotation.conjugate() * body_T_imu.translation);
  Eigen::Matrix<double, 6, 3> pose_by_force;
  pose_by_force << shift_by_tilt * tilt_by_force, tilt_by_force;

  Matrix15d c = Matrix15d::Zero();
  c.block<6, 6>(0, 0) = pose_by_force * (bias + square(sigma.acceleration) * across) * pose_by_force.transpose() +
                        square(kOriginSigma) * Matrix6d::Identity();
  c.block<6, 3>(0, 12) = pose_by_force * bias;
  c.block<3, 6>(12, 0) = c.block<6, 3>(0, 12).transpose();
  c.diagonal().segment<3>(6).setConstant(square(sigma.velocity));
  c.diagonal().segment<3>(9).setConstant(square(sigma.gyro_bias));
  c.block<3, 3>(12, 12) = bias;
  return c;
}
}  // namespace

std::optional<NavEstimate> initialiseAtRest(const std::vector<ImuSample>& samples, const Rigid& body_T_imu,
                                            const StandstillOptions& options, double accel_bias_sigma)
{
  requireIncreasingStamps(samples);
  if (samples.empty() || samples.back().stamp - samples.front().stamp < fromSeconds(options.duration)) return {};
  const Timestamp start = samples.back().stamp - fromSeconds(options.duration);
  const auto isBefore = [](const ImuSample& s, Timestamp t) { return s.stamp < t; };
  const SlowMotion motion =
      slowMotion({std::lower_bound(samples.begin(), samples.end(), start, isBefore), samples.end()});
  if (!isAtRest(motion)) return {};

  const Eigen::Vector3d up = motion.mean_accel.normalized();
  NavEstimate initial;
  initial.state.stamp = samples.back().stamp;
  initial.state.map_T_imu = levelled(up, body_T_imu);
  initial.state.bias = {motion.mean_gyro, motion.mean_accel - kGravity * up};
  const double gyro_bias = std::hypot(kGyroBiasWalk, motion.gyro_sigma);
  initial.covariance =
      covarianceOf(up, body_T_imu, accel_bias_sigma,
                   {kRestVelocity, gyro_bias, motion.accel_sigma, std::hypot(kLocalGravity, motion.accel_sigma)});
  return initial;
}

NavEstimate gravityOnly(const std::vector<ImuSample>& samples, const Rigid& body_T_imu, double accel_bias_sigma)
{
  requireIncreasingStamps(samples);
  Eigen::Vector3d mean(0, 0, 0);
  for (const ImuSample& sample : samples) mean += sample.accel / static_cast<double>(samples.size());
  if (!(mean.norm() > 0.1 * kGravity))
    throw std::invalid_argument(fmt::format(
        "mean accelerometer of {} samples = {:.3g} m/s2: cannot tell which way is up (is its unit m/s2, not g?)",
        samples.size(), mean.norm()));

  const Eigen::Vector3d up = mean.normalized();
  NavEstimate initial;
  initial.state.stamp = samples.back().stamp;
  initial.state.map_T_imu = levelled(up, body_T_imu);
  initial.covariance = covarianceOf(up, body_T_imu, accel_bias_sigma,
                                    {kMovingVelocity, kMovingGyroBias, kMovingAcceleration, accel_bias_sigma});
  return initial;
}

NavEstimate levelWithBody(Timestamp stamp)
{
  constexpr double kNoBias = 1e-6;  // of an IMU that does not exist: rad/s, m/s2
  NavEstimate initial;
  initial.state.stamp = stamp;
  auto variances = initial.covariance.diagonal();
  variances.head<6>().setConstant(kOriginSigma * kOriginSigma);
  variances.segment<3>(6).setConstant(kMovingVelocity * kMovingVelocity);
  variances.tail<6>().setConstant(kNoBias * kNoBias);
  return initial;
}
}  // namespace scanloom
