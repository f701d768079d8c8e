#pragma once
#include "mrpt_bridge/SensorInput.h"

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** Which of the input's IMUs localisation listens to; another one where that falls silent. */
class ImuInUse
{
 public:
  /**
   * `wanted` is body, the name of a lidar, or auto: the body's, else the first lidar's. Only with auto another one
   * takes over. `delay`: by how much the stamps of that first one are late. Throws ConfigError if there is no such IMU.
   */
  ImuInUse(const SensorInput&, const std::string& wanted, Duration delay);

  Rigid body_T_imu() const { return body_T_imu_; }
  bool insideLidar() const { return sensor_ != SensorImu::kBody; }

  /** "body" or the name of a lidar. */
  std::string name() const { return nameOf(sensor_); }

  /** The sample, if it is of the one in use. Those of others are remembered for a while. */
  std::optional<ImuSample> take(const SensorImu&);

  /** By the stamps, and before another one takes over. */
  static constexpr Duration kPatience = 200ms;

  /** It has read something at or after `t`. */
  bool reaches(Timestamp t) const;

  /** There are others, and one is allowed. */
  bool mayChange() const { return may_change_ && candidates().size() > 1; }

  /**
   * True if the one in use had nothing to say for kPatience before `now`, and another one had.
   * That is the one in use from here on. recent() are its samples so far, of the last seconds, and previous() those of
   * the one before.
   */
  bool changeIfSilent(Timestamp now);
  std::vector<ImuSample> recent() const { return samplesOf(sensor_); }
  std::vector<ImuSample> previous() const { return samplesOf(previous_); }

 private:
  std::vector<int> candidates() const;
  std::string nameOf(int sensor) const;
  bool silent(int sensor, Timestamp now) const;
  ImuSample inTime(const SensorImu&) const;
  std::vector<ImuSample> samplesOf(int sensor) const;

  const SensorInput& input_;
  bool may_change_;
  int first_, previous_, sensor_;
  Rigid body_T_imu_;
  Duration delay_;                                // of the first
  std::map<int, std::deque<ImuSample>> samples_;  // by sensor, of the last seconds, with the stamps that they came with
};
}  // namespace scanloom
