/** A lidar's metadata: from its file or, where only its address is configured, from the sensor. */
#pragma once
#include "input/packets/SensorHttp.h"
#include "input/rig/RigOptions.h"

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

/** A sensor that answers over HTTP: those of Ouster do. */
struct LidarSensor
{
  SensorAddress address;
  bool configure = false;  // it may be configured to send its packets to this computer
};

/** None without the key 'address'. Throws ConfigError if its value is no address. */
std::optional<LidarSensor> sensorOf(const LidarOptions&);

/** A rig starts within 2 s even if no sensor answers. */
constexpr SensorHttpLimits kRigHttpLimits{1500ms, 1024 * 1024};

/**
 * Asks the sensor. If it may be configured and sends elsewhere, its destination is set first, and only once:
 * `configure` is false from then on. Throws SensorHttpError; NotRunning also for a sensor that restarts because of
 * that.
 */
LidarMetadata metadataOf(SensorHttp&, LidarSensor&);

/** The metadata, or why a sensor did not give them. */
struct MetadataAnswer
{
  std::optional<LidarMetadata> metadata;
  std::optional<SensorHttpError> failure;
  std::optional<LidarSensor> sensor;  // to ask again; none if the metadata are from a file
};

/**
 * The file if the key 'metadata' names one, the sensor otherwise. Throws std::invalid_argument if the file can't be
 * read, ConfigError if neither is given; a sensor's failure is in the answer. Writes to no sensor.
 */
MetadataAnswer metadataOf(const LidarOptions&, const SensorHttpLimits& = kRigHttpLimits);

/** Of all lidars at the same time: it takes as long as the slowest sensor, at most the time limit. */
std::vector<MetadataAnswer> metadataOf(const std::vector<LidarOptions>&, const SensorHttpLimits& = kRigHttpLimits);
}  // namespace scanloom
