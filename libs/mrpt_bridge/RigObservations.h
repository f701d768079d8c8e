/** A rig's events as the observations of its recording: for the plugin and for our own recorder alike. */
#pragma once
#include "mrpt_bridge/Observations.h"
#include "source/RigInput.h"

#include <memory>
#include <optional>

namespace scanloom
{
RecordingHeader recordingHeader(const Rig&);

/**
 * Scans bear the label `sensorLabel` of the options, the body's IMU `imu_label`, and a lidar's own IMU
 * `<imu_label>_<name of the lidar>`; each IMU with its pose in the body frame.
 */
mrpt::obs::CObservation::Ptr toObservation(const SensorEvent&, const Rig&, const DriverOptions&);

/** A rig's captures or sockets as one stream of observations: the header, then one for each event. */
class RigObservations
{
 public:
  /** Opens the input; throws what openRig throws, and std::invalid_argument for an unknown cloud_class. */
  RigObservations(const Rig&, const DriverOptions&);

  /** Waits for it; null at the end of input. */
  mrpt::obs::CObservation::Ptr next();

  /** Live, the input ends when it is told to: what was received is still given out. From any thread. */
  void stop() { input_->stop(); }

  RigAccount account() const { return input_->account(); }
  std::vector<std::string> takeWarnings() { return input_->takeWarnings(); }

 private:
  Rig rig_;
  DriverOptions options_;
  std::unique_ptr<RigInput> input_;
  std::optional<SensorEvent> first_;  // read before the header, for its stamp
  bool header_given_ = false;
};
}  // namespace scanloom
