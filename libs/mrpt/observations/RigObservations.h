/** A rig's events as MRPT observations, for the plugin and for our own recorder. */
#pragma once
#include "input/rig/RigOptions.h"
#include "input/rig/SensorInput.h"
#include "mrpt/observations/Observations.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct Rig;

/**
 * The label of scans is the option `sensorLabel`, that of the body's IMU imu, and that of a lidar's IMU imu_<name of
 * the lidar>. The sensorPose of an IMU is its pose in the body frame.
 */
mrpt::obs::CObservation::Ptr toObservation(const SensorEvent&, const SensorSetup&, const DriverOptions&);

/** A rig's captures or sockets as one stream of observations: the header, then one for each event. */
class RigObservations
{
 public:
  /** Opens the input; throws what openRig throws, and std::invalid_argument for an unknown cloud_class. */
  RigObservations(const Rig&, const DriverOptions&);

  /** Waits for the next one; null at the end of the input. */
  mrpt::obs::CObservation::Ptr next();

  /** Ends the input; next() still gives what was received. May be called from any thread. */
  void stop() { input_->stop(); }

  RigAccount account() const { return input_->account(); }
  std::vector<std::string> takeWarnings() { return input_->takeWarnings(); }

 private:
  DriverOptions options_;
  std::unique_ptr<SensorInput> input_;
  std::optional<SensorEvent> first_;  // read before the header is given, which gets its stamp
  bool header_given_ = false;
};
}  // namespace scanloom
