#pragma once
#include "estimation/imu/ImuBuffer.h"
#include "estimation/imu/ImuScreening.h"
#include "input/rig/SensorInput.h"

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** "body" or the name of a lidar. */
std::string imuName(const SensorSetup&, int sensor);

/**
 * The choice among the input's IMUs: the one that localisation uses; another one where it shakes much more, and while
 * it is silent.
 */
class ImuInUse
{
 public:
  /**
   * `wanted` is body, the name of a lidar, or auto: the body's, else the first lidar's. Only with auto may another one
   * take over. The stamps of the first IMU in use are late by `delay`. Throws ConfigError if there is no such IMU. The
   * input must outlive this.
   */
  ImuInUse(const SensorInput&, const std::string& wanted, Duration delay);

  Rigid body_T_imu() const { return poseOf(sensor_); }
  int sensor() const { return sensor_; }  // SensorImu::sensor
  bool insideLidar() const { return sensor_ != SensorImu::kBody; }

  /** imuName() of the one in use, and of the one before it. */
  std::string name() const { return nameOf(sensor_); }
  std::string previousName() const { return nameOf(previous_); }

  /**
   * The samples of the IMU in use that passed its screening with this one, with their delay subtracted; none for
   * another IMU's. Those of every IMU are kept for 5 s.
   */
  std::vector<ImuSample> take(const SensorImu&);

  /**
   * How long a scan waits for the IMU to cover it: `imu_wait`, or longer where another IMU may take over, so that the
   * one in use counts as silent by then.
   */
  Duration patience(Duration imu_wait) const;

  /**
   * Once, when all IMUs that send have been received for a second: if the one in use shakes ten times as much as
   * another one, that one comes before all others from here on, is in use, and the result is true.
   */
  bool changeIfShaken();

  /**
   * If the IMU in use is silent at `now` and another one is not: that one is in use from here on, and the result is
   * true. recent() are its samples of the last seconds, previous() those of the one before.
   */
  bool changeIfSilent(Timestamp now);

  /**
   * The same if an IMU that comes before the one in use (the body's, then by lidar) has not been silent for the last
   * 5 s, and both turned alike: one with other stamps does not return.
   */
  bool returnToBetter(Timestamp now);

  std::vector<ImuSample> recent() const { return samplesOf(sensor_); }
  std::vector<ImuSample> previous() const { return samplesOf(previous_); }

  /** By the IMU's name; only those with refused samples. */
  std::map<std::string, RefusedReadings> refused() const;

 private:
  struct Received
  {
    ImuScreening screening;
    std::deque<ImuSample> kept;  // with their delay
  };

  SensorSetup setup() const { return input_.setup(); }
  Rigid poseOf(int sensor) const { return setup().body_T_imu.at(sensor); }
  std::string nameOf(int sensor) const { return imuName(setup(), sensor); }
  bool silent(int sensor, Timestamp now) const;
  bool receivedWithoutBreak(int sensor) const;
  void change(int sensor);
  ImuSample withoutDelay(int sensor, ImuSample) const;
  std::vector<ImuSample> samplesOf(int sensor) const;

  const SensorInput& input_;
  bool may_change_, compared_ = false;
  std::vector<int> sensors_;  // the better ones first
  int first_, previous_, sensor_;
  Duration delay_;                    // of the first
  std::map<int, Received> received_;  // by sensor
};

/** As the constructor. None: `wanted` is none, or is auto and the input has no IMU. */
std::optional<ImuInUse> chosenImu(const SensorInput&, const std::string& wanted, Duration delay);
}  // namespace scanloom
