/** What a lidar says about itself: from its file, or asked of the sensor where only its address is configured. */
#pragma once
#include "source/RigOptions.h"
#include "source/SensorHttp.h"

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct LidarMetadata
{
  std::string text;
  std::string name;  // for errors: the file, or "sensor 10.5.6.101"
};

/** A sensor and what it may be asked to do. */
struct LidarSensor
{
  SensorAddress address;
  bool configure = false;  // it may be told to send its packets to this computer
};

/** Where the lidar can be asked; nothing without the key 'address'. Throws ConfigError if that is no address. */
std::optional<LidarSensor> sensorOf(const LidarOptions&);

/** Short enough that a rig starts within 2 s whatever its sensors do. */
constexpr SensorHttpLimits kRigHttpLimits{1500ms, 1024 * 1024};

/**
 * Asks the sensor. One that may be configured is told its destination before, if it has another one, and only once:
 * `configure` is false from then on. Throws SensorHttpError; NotRunning also for a sensor that starts anew thereby.
 */
LidarMetadata metadataOf(SensorHttp&, LidarSensor&);

/** The metadata, or why a sensor did not give them. */
struct MetadataAnswer
{
  std::optional<LidarMetadata> metadata;
  std::optional<SensorHttpError> failure;
  std::optional<LidarSensor> sensor;  // whom to ask again; none where a file is given: it is kept
};

/**
 * The file if the key 'metadata' names one, the sensor otherwise. Throws std::invalid_argument if the file can't be
 * read, ConfigError if neither is given; what goes wrong with a sensor is in the answer. Writes to no sensor.
 */
MetadataAnswer metadataOf(const LidarOptions&, const SensorHttpLimits& = kRigHttpLimits);

/** Of all lidars at once: a sensor that does not answer keeps nobody waiting for longer than its own time limit. */
std::vector<MetadataAnswer> metadataOf(const std::vector<LidarOptions>&, const SensorHttpLimits& = kRigHttpLimits);
}  // namespace scanloom
