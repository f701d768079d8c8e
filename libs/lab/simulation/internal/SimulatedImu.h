#pragma once
#include "base/core/ImuSample.h"
#include "lab/simulation/internal/Drive.h"
#include "lab/simulation/internal/Random.h"
#include "lab/simulation/internal/SimulatedClock.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
/** Rate and errors of an IMU, by default like a 3DM-GQ7 (assumed). Not keys: the body's IMU and those of lidars differ.
 */
struct SimulatedImuOptions
{
  double rate = 200;  // Hz: samples per second
  double gyro_noise_deg =
      0.003;  // deg/s/sqrt(Hz): white noise density of the gyroscope; 3DM-GQ7-like 0.003, Ouster-like 0.01
  double accel_noise = 2.5e-4;  // m/s2/sqrt(Hz): white noise density of the accelerometer; 3DM-GQ7-like 2.5e-4 (25 ug),
                                // Ouster-like 1.77e-3 (180 ug)
  double gyro_instability = 1.5;      // deg/h: standard deviation of the gyroscope's varying bias; 3DM-GQ7-like 1.5
  double accel_instability = 1.5e-4;  // m/s2: standard deviation of the accelerometer's varying bias; 1.5e-4 are 15 ug
  double correlation_time = 200;      // s: correlation time of the varying biases, first-order Gauss-Markov
  double gyro_turn_on_deg = 0.02;     // deg/s: standard deviation of the gyroscope's constant bias, each axis
  double accel_turn_on = 0.002;       // m/s2: standard deviation of the accelerometer's constant bias, each axis
};

/** Values like those of the IMU inside an Ouster lidar. */
SimulatedImuOptions ousterLikeImu();

/** The constant part of the biases. */
struct TurnOnBias
{
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();   // rad/s
  Eigen::Vector3d accel = Eigen::Vector3d::Zero();  // m/s2
};

/** What an IMU without errors measures at body_T_imu, in its own frame. */
ImuSample idealImuSample(const Motion&, const Rigid& body_T_imu, Timestamp);

/** Start and duration of a recording. */
struct RecordingSpan
{
  Timestamp start;      // t = 0 of the drive
  double duration = 0;  // s

  double secondsAt(Timestamp stamp) const { return seconds(stamp - start); }
  Timestamp end() const { return start + fromSeconds(duration); }
};

/** Pose, timing and errors of an IMU. */
struct ImuSetup
{
  Rigid body_T_imu;
  Timestamp first;  // true time of the first sample
  SimulatedImuOptions errors;
  ClockError clock;
  RandomStream stream = RandomStream::BodyImu;
  std::uint64_t place = 0;  // number of the lidar that the IMU is in
  EngineVibration mount{};  // its vibration beside that of the body, along the body's axes
};

/**
 * The samples of one IMU, in time order. A reading is the mean over the time between two readings, half of it before
 * the stamp and half after: an IMU samples much faster than it reports, so that vibration faster than its rate is
 * damped instead of showing as slow motion.
 */
class ImuStream
{
 public:
  /** The drive must outlive the stream. */
  ImuStream(const Drive&, const RecordingSpan&, const ImuSetup&, std::uint64_t seed);

  /** A sample with its true time. */
  struct Sample
  {
    Timestamp truth;
    ImuSample reading;  // stamped by the IMU's clock
  };

  /** The samples before `until` and within the span that no earlier call returned. */
  std::vector<Sample> before(Timestamp until);

  const TurnOnBias& turnOnBias() const { return turn_on_; }

 private:
  Sample next();
  ImuSample meanReading(Timestamp truth) const;

  const Drive& drive_;
  RecordingSpan span_;
  ImuSetup setup_;
  std::uint64_t seed_;
  TurnOnBias turn_on_;
  Eigen::Vector3d gyro_wander_, accel_wander_;
  std::uint64_t index_ = 0;
};
}  // namespace scanloom
