#pragma once
#include "rig/SensorInput.h"

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** The choice among the input's IMUs: the one that localisation uses, and another one if it falls silent. */
class ImuInUse
{
 public:
  /**
   * `wanted` is body, the name of a lidar, or auto: the body's, else the first lidar's. Only with auto may another one
   * take over. The stamps of the first IMU in use are late by `delay`. Throws ConfigError if there is no such IMU. The
   * input must outlive this.
   */
  ImuInUse(const SensorInput&, const std::string& wanted, Duration delay);

  Rigid body_T_imu() const { return setup().body_T_imu.at(sensor_); }
  bool insideLidar() const { return sensor_ != SensorImu::kBody; }

  /** "body" or the name of a lidar; of the one in use, and of the one before it. */
  std::string name() const { return nameOf(sensor_); }
  std::string previousName() const { return nameOf(previous_); }

  /** The sample with its delay subtracted, if it is of the IMU in use. Samples of the others are kept for 5 s. */
  std::optional<ImuSample> take(const SensorImu&);

  /** An IMU without a sample for so long, by the stamps, is silent. */
  static constexpr Duration kSilence = 200ms;

  /**
   * How long a scan waits for the IMU to cover it: `imu_wait`, or longer where another IMU may take over, so that the
   * one in use counts as silent by then.
   */
  Duration patience(Duration imu_wait) const;

  /**
   * If the IMU in use is silent at `now` and another one is not: that one is in use from here on, and the result is
   * true. recent() are its samples of the last seconds, previous() those of the one before.
   */
  bool changeIfSilent(Timestamp now);
  std::vector<ImuSample> recent() const { return samplesOf(sensor_); }
  std::vector<ImuSample> previous() const { return samplesOf(previous_); }

 private:
  SensorSetup setup() const { return input_.setup(); }
  std::string nameOf(int sensor) const;
  bool silent(int sensor, Timestamp now) const;
  ImuSample withoutDelay(const SensorImu&) const;
  std::vector<ImuSample> samplesOf(int sensor) const;

  const SensorInput& input_;
  bool may_change_;
  int first_, previous_, sensor_;
  Duration delay_;                                // of the first
  std::map<int, std::deque<ImuSample>> samples_;  // by sensor, with their delay
};
}  // namespace scanloom
