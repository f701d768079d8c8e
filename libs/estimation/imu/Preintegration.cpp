#include "estimation/imu/Preintegration.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
using Matrix96d = Eigen::Matrix<double, 9, 6>;

/** Derivatives of the error at a step's end by the error at its start and by that of the readings (gyro, accel). */
struct StepJacobians
{
  Matrix9d by_start;
  Matrix96d by_reading;
};

/** Derivatives of advance(), with one error of the readings for the whole step. */
StepJacobians jacobiansOfStep(const ImuDelta& start, const ImuDelta& end, const ImuSample& first,
                              const ImuSample& second, const ImuBias& bias)
{
  const double dt = seconds(second.stamp - first.stamp);
  const Eigen::Vector3d turn = (0.5 * (first.gyro + second.gyro) - bias.gyro) * dt;
  const Eigen::Matrix3d r0 = start.rotation.toRotationMatrix();
  const Eigen::Matrix3d r1 = end.rotation.toRotationMatrix();
  const Eigen::Matrix3d rotation_by_rotation = expSo3(turn).toRotationMatrix().transpose();
  const Eigen::Matrix3d rotation_by_gyro = rightJacobianSo3(turn) * dt;
  const Eigen::Matrix3d force0_by_rotation = -r0 * skew(first.accel - bias.accel);
  const Eigen::Matrix3d force1_by_end = -r1 * skew(second.accel - bias.accel);
  const Eigen::Matrix3d force1_by_rotation = force1_by_end * rotation_by_rotation;
  const Eigen::Matrix3d force1_by_gyro = force1_by_end * rotation_by_gyro;

  StepJacobians j;
  j.by_start.setIdentity();
  j.by_start.block<3, 3>(0, 0) = rotation_by_rotation;
  j.by_start.block<3, 3>(3, 0) = dt / 2 * (force0_by_rotation + force1_by_rotation);
  j.by_start.block<3, 3>(6, 0) = dt * dt / 6 * (2 * force0_by_rotation + force1_by_rotation);
  j.by_start.block<3, 3>(6, 3) = dt * Eigen::Matrix3d::Identity();

  j.by_reading.setZero();
  j.by_reading.block<3, 3>(0, 0) = rotation_by_gyro;
  j.by_reading.block<3, 3>(3, 0) = dt / 2 * force1_by_gyro;
  j.by_reading.block<3, 3>(6, 0) = dt * dt / 6 * force1_by_gyro;
  j.by_reading.block<3, 3>(3, 3) = dt / 2 * (r0 + r1);
  j.by_reading.block<3, 3>(6, 3) = dt * dt / 6 * (2 * r0 + r1);
  return j;
}

/** Variances per unit of time: divided by the step they are those of the mean reading over the step. */
Eigen::Matrix<double, 6, 1> densities(const ImuNoise& noise)
{
  const double gyro = noise.gyro_noise_deg * M_PI / 180;
  Eigen::Matrix<double, 6, 1> d;
  d << Eigen::Vector3d::Constant(gyro * gyro), Eigen::Vector3d::Constant(noise.accel_noise * noise.accel_noise);
  return d;
}

Eigen::Matrix<double, 6, 1> variancesOf(double rate, double force)
{
  Eigen::Matrix<double, 6, 1> variances;
  variances << Eigen::Vector3d::Constant(rate * rate), Eigen::Vector3d::Constant(force * force);
  return variances;
}

/**
 * Variances of the mean over a step to `end`, between readings that are far apart or of one that is held: the motion of
 * a machine in between is not linear. Where readings were refused it may have been a shock, which the lidar must tell.
 */
Eigen::Matrix<double, 6, 1> unseenMotion(double dt, const ImuSample& end)
{
  constexpr double kMissingSamples = 0.025, kWholeCycle = 0.2;  // s
  constexpr double kRate = 0.15, kForce = 1.0;                  // rad/s, m/s2
  constexpr double kShockRate = 0.5, kShockForce = 10.0;        // rad/s, m/s2
  if (end.after_refused) return variancesOf(kShockRate, kShockForce);
  const double share = dt > kMissingSamples ? std::min(1.0, dt / kWholeCycle) : 0;
  return share * share * variancesOf(kRate, kForce);
}

void requireStepsInTimeOrder(const std::vector<ImuSample>& samples)
{
  if (samples.size() < 2)
    throw std::invalid_argument(fmt::format("preintegration needs two samples or more, got {}", samples.size()));
  requireIncreasingStamps(samples);
}
}  // namespace

Preintegration preintegrate(std::vector<ImuSample> samples, const ImuBias& bias, const ImuNoise& noise)
{
  requireStepsInTimeOrder(samples);
  const Eigen::Matrix<double, 6, 1> density = densities(noise);

  ImuDelta delta;
  Matrix9d covariance = Matrix9d::Zero();
  Matrix96d by_bias = Matrix96d::Zero();
  for (std::size_t k = 0; k + 1 < samples.size(); ++k)
  {
    const ImuDelta end = advance(delta, samples[k], samples[k + 1], bias);
    const StepJacobians j = jacobiansOfStep(delta, end, samples[k], samples[k + 1], bias);
    const double dt = seconds(samples[k + 1].stamp - samples[k].stamp);
    const Eigen::Matrix<double, 6, 1> variance = density / dt + unseenMotion(dt, samples[k + 1]);

    covariance = j.by_start * covariance * j.by_start.transpose() +
                 j.by_reading * variance.asDiagonal() * j.by_reading.transpose();  // eq. (63)
    by_bias = j.by_start * by_bias - j.by_reading;  // a bias is a constant error of every reading, with a minus
    delta = end;
  }

  Preintegration motion;
  motion.from = samples.front().stamp;
  motion.to = samples.back().stamp;
  motion.bias = bias;
  motion.delta = delta;
  motion.covariance = 0.5 * (covariance + covariance.transpose());
  motion.rotation_by_gyro = by_bias.block<3, 3>(0, 0);
  motion.velocity_by_gyro = by_bias.block<3, 3>(3, 0);
  motion.velocity_by_accel = by_bias.block<3, 3>(3, 3);
  motion.position_by_gyro = by_bias.block<3, 3>(6, 0);
  motion.position_by_accel = by_bias.block<3, 3>(6, 3);
  motion.samples = std::move(samples);
  return motion;
}

Preintegration corrected(const Preintegration& motion, const ImuBias& bias, const ImuNoise& noise)
{
  const bool within_reach = (bias.gyro - motion.bias.gyro).norm() <= kGyroBiasReach &&
                            (bias.accel - motion.bias.accel).norm() <= kAccelBiasReach;
  return within_reach ? motion : preintegrate(motion.samples, bias, noise);
}

ImuDelta deltaAt(const Preintegration& motion, const ImuBias& bias)
{
  const Eigen::Vector3d gyro = bias.gyro - motion.bias.gyro;
  const Eigen::Vector3d accel = bias.accel - motion.bias.accel;
  return {(motion.delta.rotation * expSo3(motion.rotation_by_gyro * gyro)).normalized(),
          motion.delta.velocity + motion.velocity_by_gyro * gyro + motion.velocity_by_accel * accel,
          motion.delta.position + motion.position_by_gyro * gyro + motion.position_by_accel * accel};
}

NavState predict(const NavState& from, const Preintegration& motion)
{
  if (from.stamp != motion.from)
    throw std::invalid_argument(fmt::format("motion starts at {} ns, the state to predict from is of {} ns",
                                            nanoseconds(motion.from), nanoseconds(from.stamp)));
  return compose(from, deltaAt(motion, from.bias), motion.to);
}

std::vector<NavState> predictAt(const NavState& from, const std::vector<ImuSample>& samples,
                                const std::vector<Timestamp>& stamps)
{
  requireStepsInTimeOrder(samples);
  if (from.stamp != samples.front().stamp)
    throw std::invalid_argument(fmt::format("the first IMU sample is of {} ns, the state to predict from of {} ns",
                                            nanoseconds(samples.front().stamp), nanoseconds(from.stamp)));
  if (!std::is_sorted(stamps.begin(), stamps.end()) ||
      (!stamps.empty() && (stamps.front() < from.stamp || stamps.back() > samples.back().stamp)))
    throw std::invalid_argument("stamps to predict at must be sorted and within the IMU samples' span");

  std::vector<NavState> states;
  states.reserve(stamps.size());
  ImuDelta delta;
  std::size_t k = 0;
  for (const Timestamp stamp : stamps)
  {
    for (; samples[k + 1].stamp < stamp; ++k) delta = advance(delta, samples[k], samples[k + 1], from.bias);
    const ImuDelta at_stamp =
        stamp == samples[k].stamp
            ? delta
            : advance(delta, samples[k], interpolate(samples[k], samples[k + 1], stamp), from.bias);
    states.push_back(compose(from, at_stamp, stamp));
  }
  return states;
}
}  // namespace scanloom
