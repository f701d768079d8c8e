/** A rig's events as the observations of its recording: for the plugin and for our own recorder alike. */
#pragma once
#include "mrpt_bridge/Observations.h"
#include "source/Rig.h"

#include <optional>

namespace scanloom
{
RecordingHeader recordingHeader(const Rig&);

/**
 * Scans bear the label `sensorLabel` of the options, the body's IMU `imu_label`, and a lidar's own IMU
 * `<imu_label>_<name of the lidar>`; each IMU with its pose in the body frame.
 */
mrpt::obs::CObservation::Ptr toObservation(const SensorEvent&, const Rig&, const DriverOptions&);

/** A rig's captures as one stream of observations: the header, then one for each event. */
class RigObservations
{
 public:
  /** Opens the captures; throws what RigReplay throws, and std::invalid_argument for an unknown cloud_class. */
  RigObservations(const Rig&, const DriverOptions&);

  /** Null at the end of input. */
  mrpt::obs::CObservation::Ptr next();

  const RigReplay& replay() const { return replay_; }

 private:
  Rig rig_;
  DriverOptions options_;
  RigReplay replay_;
  std::optional<SensorEvent> event_;  // the next one; read ahead once, for the header's stamp
  bool header_given_ = false;
};
}  // namespace scanloom
