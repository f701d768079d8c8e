/**
 * IMU readings between two instants as one relative motion with covariance and first-order bias correction.
 * C. Forster, L. Carlone, F. Dellaert, D. Scaramuzza: On-Manifold Preintegration for Real-Time Visual-Inertial
 * Odometry, IEEE Trans. Robotics 33 (2017); equation numbers below are its.
 */
#pragma once
#include "base/core/Field.h"
#include "base/core/ImuSample.h"
#include "estimation/imu/NavState.h"
#include "estimation/imu/internal/ImuStep.h"

#include <vector>

namespace scanloom
{
/** White noise densities and random walks of the biases. */
struct ImuNoise
{
  double gyro_noise_deg = 0.003;     // deg/s/sqrt(Hz)
  double accel_noise = 2.5e-4;       // m/s2/sqrt(Hz)
  double gyro_bias_walk_deg = 4e-4;  // deg/s/sqrt(s)
  double accel_bias_walk = 1e-4;     // m/s2/sqrt(s)
  double accel_bias_sigma = 0.05;    // m/s2, of the accelerometer's bias at the start

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.gyro_noise_deg,
          Field{"gyro_noise_deg", "deg/s/sqrt(Hz)", "white noise density of the gyroscope", above(0)});
    visit(o.accel_noise, Field{"accel_noise", "m/s2/sqrt(Hz)", "white noise density of the accelerometer", above(0)});
    visit(o.gyro_bias_walk_deg,
          Field{"gyro_bias_walk_deg", "deg/s/sqrt(s)", "random walk of the gyroscope's bias", above(0)});
    visit(o.accel_bias_walk,
          Field{"accel_bias_walk", "m/s2/sqrt(s)", "random walk of the accelerometer's bias", above(0)});
  }
};

/** Tangent order of the 9-vectors: rotation, velocity, position (as in the paper). */
using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

struct Preintegration
{
  Timestamp from, to;
  ImuBias bias;                                                // linearisation point
  ImuDelta delta;                                              // Delta R, v and p, eq. (35)
  Matrix9d covariance = Matrix9d::Zero();                      // eq. (63); of rank 6 where there is one step only
  Eigen::Matrix3d rotation_by_gyro = Eigen::Matrix3d::Zero();  // the five bias Jacobians, eq. (44) and appendix B
  Eigen::Matrix3d velocity_by_gyro = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d velocity_by_accel = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d position_by_gyro = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d position_by_accel = Eigen::Matrix3d::Zero();
  std::vector<ImuSample> samples;  // to integrate again when the bias has moved too far

  double duration() const { return seconds(to - from); }
};

/**
 * From samples in time order whose first and last stamps are the interval's ends (ImuBuffer::between).
 * Throws std::invalid_argument if there are fewer than two, or if a stamp is not after the one before it.
 */
Preintegration preintegrate(std::vector<ImuSample> samples, const ImuBias&, const ImuNoise&);

/** If a bias is farther than this from the linearisation point, the samples are integrated again. */
inline constexpr double kGyroBiasReach = 0.01;  // rad/s
inline constexpr double kAccelBiasReach = 0.1;  // m/s2

/** `motion` itself if `bias` is within reach of its linearisation point, else integrated again at `bias`. */
Preintegration corrected(const Preintegration& motion, const ImuBias& bias, const ImuNoise&);

/** The motion at `bias`, to first order: eq. (44). */
ImuDelta deltaAt(const Preintegration& motion, const ImuBias& bias);

/**
 * The state at motion.to from the state at motion.from; the motion is corrected to from.bias to first order. Throws
 * std::invalid_argument if from.stamp is not motion.from.
 */
NavState predict(const NavState& from, const Preintegration& motion);

/**
 * The state at each of `stamps`, integrating the samples from `from` with its bias. Throws std::invalid_argument
 * unless from.stamp is the first sample's, and the stamps are sorted and within the samples' span.
 */
std::vector<NavState> predictAt(const NavState& from, const std::vector<ImuSample>& samples,
                                const std::vector<Timestamp>& stamps);
}  // namespace scanloom
