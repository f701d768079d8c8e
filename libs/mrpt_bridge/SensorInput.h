/** Scans and IMU samples in time order, wherever they come from: captures through the batcher, or a rawlog. */
#pragma once
#include "core/StageTimes.h"
#include "mrpt_bridge/RecordingHeader.h"
#include "source/RigInput.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
class ImuDriver;

class SensorInput
{
 public:
  virtual ~SensorInput() = default;

  /** Nothing if nothing came within `patience` (files let nobody wait), and nothing once ended(). Throws what its
   * reader throws. */
  virtual std::optional<SensorEvent> next(Duration patience) = 0;

  /** Nothing more will come. */
  virtual bool ended() const = 0;

  /** Lidars by sensor id, and the rate of the scans. */
  virtual const RecordingHeader& header() const = 0;

  /** Where an IMU sits; nothing if there is none (or none was seen yet): kBody or a sensor id. */
  virtual std::optional<Rigid> body_T_imu(int sensor) const = 0;

  /** Share of the input that was read, 0 to 1; 0 where it is not known. */
  virtual double progress() const = 0;

  /** What was counted on the way, by name: packets and blocks per lidar. */
  virtual std::map<std::string, std::uint64_t> counts() const = 0;

  /** What threads of its own took, by stage, beside whoever calls next(). */
  virtual std::map<std::string, StageTime> stages() const { return {}; }

  /** What a person should know, since the last call: lidars that fell silent, restarted, ...; damage to a file. */
  virtual std::vector<std::string> takeWarnings() = 0;
};

/** Whatever reads a rig; `has_body_imu`: samples of the body's own IMU come with it. */
std::unique_ptr<SensorInput> makeRigSensorInput(const Rig&, std::unique_ptr<RigInput>, bool has_body_imu);

/** The same with the body's IMU from a driver of its own, at the pose that it says. Throws what ImuDriver does. */
std::unique_ptr<SensorInput> makeRigSensorInput(const Rig&, std::unique_ptr<RigInput>, std::unique_ptr<ImuDriver>);

/** The captures of a rig. */
std::unique_ptr<SensorInput> makeCaptureInput(const Rig&);

/**
 * A rawlog of ours; `only` names the lidars whose columns are wanted, empty means all. Throws std::runtime_error if it
 * can't be opened or has no header, ConfigError for a name that no lidar has.
 */
std::unique_ptr<SensorInput> makeRawlogInput(const std::filesystem::path&, const std::vector<std::string>& only = {});

/** Per lidar, as `<name>.<fate>`: the batcher's accounts, the router's strangers, the losses of captures or sockets. */
std::map<std::string, std::uint64_t> countsOf(const RigAccount&);
}  // namespace scanloom
