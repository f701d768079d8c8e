#include "imu/ImuInitialisation.h"

#include "core/Angle.h"
#include "imu/ImuStep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr int kParts = 8;

// Noise of the sensors in the mean of one part: allowed in addition to max_slow_share.
constexpr double kQuietAccel = 0.01;           // m/s2
constexpr double kQuietGyro = 0.05 * kDegree;  // rad/s

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

struct Means
{
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();
  Eigen::Vector3d accel = Eigen::Vector3d::Zero();
};

template <typename Iterator>
Means meansOf(Iterator first, Iterator last)
{
  Means sum;
  for (auto s = first; s != last; ++s)
  {
    sum.gyro += s->gyro;
    sum.accel += s->accel;
  }
  const auto n = static_cast<double>(std::distance(first, last));
  return {sum.gyro / n, sum.accel / n};
}

/** Root of the mean squared distance from `centre`, as (gyro, accel). */
template <typename Readings>
Eigen::Vector2d deviationsFrom(const Means& centre, const Readings& readings)
{
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const auto& r : readings)
    sum += Eigen::Vector2d((r.gyro - centre.gyro).squaredNorm(), (r.accel - centre.accel).squaredNorm());
  return (sum / static_cast<double>(std::size(readings))).cwiseSqrt();
}

/** Standard deviations are over three axes; the slow ones are of the means of kParts equal parts. */
struct ImuStatistics
{
  Eigen::Vector3d mean_gyro = Eigen::Vector3d::Zero();   // rad/s
  Eigen::Vector3d mean_accel = Eigen::Vector3d::Zero();  // m/s2
  double gyro_deviation = 0;                             // rad/s
  double accel_deviation = 0;                            // m/s2
  double slow_gyro_deviation = 0;                        // rad/s
  double slow_accel_deviation = 0;                       // m/s2
};

ImuStatistics statisticsOf(const std::vector<ImuSample>& samples)
{
  if (samples.empty()) return {};
  const Means mean = meansOf(samples.begin(), samples.end());
  const Eigen::Vector2d deviation = deviationsFrom(mean, samples);

  std::vector<Means> parts;
  for (std::size_t k = 0; k < kParts; ++k)
  {
    const auto cut = [&](std::size_t part) { return static_cast<std::ptrdiff_t>(samples.size() * part / kParts); };
    if (cut(k) != cut(k + 1)) parts.push_back(meansOf(samples.begin() + cut(k), samples.begin() + cut(k + 1)));
  }
  const Eigen::Vector2d slow = deviationsFrom(mean, parts);
  return {mean.gyro, mean.accel, deviation.x(), deviation.y(), slow.x(), slow.y()};
}

bool isAtRest(const ImuStatistics& s, const StandstillOptions& o)
{
  return s.accel_deviation <= o.max_accel_deviation && s.gyro_deviation <= o.max_gyro_deviation_deg * kDegree &&
         s.slow_accel_deviation <= kQuietAccel + o.max_slow_share * s.accel_deviation &&
         s.slow_gyro_deviation <= kQuietGyro + o.max_slow_share * s.gyro_deviation &&
         s.mean_gyro.norm() <= o.max_mean_gyro_deg * kDegree &&
         std::abs(s.mean_accel.norm() - kGravity) <= o.max_gravity_error;
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
  const ImuStatistics statistics =
      statisticsOf({std::lower_bound(samples.begin(), samples.end(), start, isBefore), samples.end()});
  if (!isAtRest(statistics, options)) return {};

  const Eigen::Vector3d up = statistics.mean_accel.normalized();
  NavEstimate initial;
  initial.state.stamp = samples.back().stamp;
  initial.state.map_T_imu = levelled(up, body_T_imu);
  initial.state.bias = {statistics.mean_gyro, statistics.mean_accel - kGravity * up};
  const double gyro_bias = std::hypot(kGyroBiasWalk, statistics.slow_gyro_deviation / std::sqrt(kParts));
  const double mean_accel = statistics.slow_accel_deviation / std::sqrt(kParts);
  initial.covariance = covarianceOf(up, body_T_imu, accel_bias_sigma,
                                    {kRestVelocity, gyro_bias, mean_accel, std::hypot(kLocalGravity, mean_accel)});
  return initial;
}

NavEstimate gravityOnly(const std::vector<ImuSample>& samples, const Rigid& body_T_imu, double accel_bias_sigma)
{
  requireIncreasingStamps(samples);
  const ImuStatistics statistics = statisticsOf(samples);
  if (!(statistics.mean_accel.norm() > 0.1 * kGravity))
    throw std::invalid_argument(fmt::format(
        "mean accelerometer of {} samples = {:.3g} m/s2: cannot tell which way is up (is its unit m/s2, not g?)",
        samples.size(), statistics.mean_accel.norm()));

  const Eigen::Vector3d up = statistics.mean_accel.normalized();
  NavEstimate initial;
  initial.state.stamp = samples.back().stamp;
  initial.state.map_T_imu = levelled(up, body_T_imu);
  initial.covariance = covarianceOf(up, body_T_imu, accel_bias_sigma,
                                    {kMovingVelocity, kMovingGyroBias, kMovingAcceleration, accel_bias_sigma});
  return initial;
}
}  // namespace scanloom
