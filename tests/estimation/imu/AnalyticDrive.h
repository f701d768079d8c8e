/** A drive in closed form: position and attitude are sums of sines, so that what an IMU reads on it is exact. */
#pragma once
#include "base/core/ImuSample.h"
#include "base/core/So3.h"
#include "estimation/imu/NavState.h"

#include <random>
#include <vector>

namespace scanloom
{
/** One coordinate over time, with its two derivatives: offset + rate t + amplitude sin(frequency t + phase). */
struct Sine
{
  double offset = 0, rate = 0, amplitude = 0, frequency = 0, phase = 0;

  double at(double t) const { return offset + rate * t + amplitude * std::sin(frequency * t + phase); }
  double firstDerivative(double t) const { return rate + amplitude * frequency * std::cos(frequency * t + phase); }
  double secondDerivative(double t) const
  {
    return -amplitude * frequency * frequency * std::sin(frequency * t + phase);
  }
};

/** An IMU in a body. */
inline const Rigid kBodyFromImu = Rigid::fromXyzYawPitchRoll(0.15, -0.3, 2.85, 1.5, 0.1, -0.2);

/** What an ideal IMU reads whose poses these are, by their differences. */
template <typename PoseAt>
ImuSample sampleByDifferences(const PoseAt& map_T_imu, Timestamp t)
{
  const Rigid before = map_T_imu(t - 1ms), now = map_T_imu(t), after = map_T_imu(t + 1ms);
  const Eigen::Vector3d acceleration = (before.translation - 2 * now.translation + after.translation) / 1e-6;
  return {t, logSo3(before.rotation.conjugate() * after.rotation) / 0.002,
          now.rotation.conjugate() * (acceleration - gravityInMap())};
}

/** A vehicle that weaves, rolls and pitches; the IMU stands in the frame that moves. */
struct AnalyticDrive
{
  Sine x{0, 1.0, 0.3, 1.7, 0.2}, y{0, 0.1, 0.8, 0.9, 1.0}, z{1, 0, 0.1, 2.3, 0.5};
  Sine yaw{0.3, 0.1, 0.5, 0.8, 0.1}, pitch{0, 0, 0.08, 2.1, 0.7}, roll{0, 0, 0.1, 1.6, 1.9};

  Eigen::Vector3d acceleration(double t) const
  {
    return {x.secondDerivative(t), y.secondDerivative(t), z.secondDerivative(t)};
  }

  NavState stateAt(Timestamp stamp, const ImuBias& bias = {}) const
  {
    const double t = seconds(stamp.time_since_epoch());
    return {stamp,
            Rigid::fromXyzYawPitchRoll(x.at(t), y.at(t), z.at(t), yaw.at(t), pitch.at(t), roll.at(t)),
            {x.firstDerivative(t), y.firstDerivative(t), z.firstDerivative(t)},
            bias};
  }

  /** What an ideal IMU with this bias reads; rates from the Euler angles' (Rz Ry Rx). */
  ImuSample sampleAt(Timestamp stamp, const ImuBias& bias = {}) const
  {
    const double t = seconds(stamp.time_since_epoch());
    const double p = pitch.at(t), r = roll.at(t);
    const double dy = yaw.firstDerivative(t), dp = pitch.firstDerivative(t), dr = roll.firstDerivative(t);
    const Eigen::Vector3d rate{dr - std::sin(p) * dy, std::cos(r) * dp + std::sin(r) * std::cos(p) * dy,
                               -std::sin(r) * dp + std::cos(r) * std::cos(p) * dy};
    const Eigen::Quaterniond map_R_imu = stateAt(stamp).map_T_imu.rotation;
    return {stamp, rate + bias.gyro, map_R_imu.conjugate() * (acceleration(t) - gravityInMap()) + bias.accel};
  }

  std::vector<ImuSample> samples(Timestamp from, Timestamp to, Duration period, const ImuBias& bias = {}) const
  {
    std::vector<ImuSample> all;
    for (Timestamp t = from; t <= to; t += period) all.push_back(sampleAt(t, bias));
    return all;
  }
};

/** Independent normal deviates from a fixed seed. */
class Noise
{
 public:
  explicit Noise(unsigned seed) : engine_(seed) {}

  template <int Size>
  Eigen::Matrix<double, Size, 1> normal(double sigma)
  {
    Eigen::Matrix<double, Size, 1> v;
    for (double& x : v) x = sigma * distribution_(engine_);
    return v;
  }

 private:
  std::mt19937 engine_;
  std::normal_distribution<double> distribution_;
};
}  // namespace scanloom
