/** One lidar of a rig, whose metadata may not be known yet, and how to ask its sensor. */
#pragma once
#include "input/lidar/PacketDecoder.h"
#include "input/rig/PacketRouter.h"
#include "input/rig/internal/LidarMetadata.h"

#include <memory>

namespace scanloom
{
struct RigSensor
{
  LidarOptions options;
  std::string key;  // of its keys in the configuration: "lidar2" of lidar2_port
  Rigid body_T_sensor;
  std::optional<LidarSensor> sensor;      // none if its metadata are in a file
  std::optional<LidarMetadata> metadata;  // none while not known
  std::string failure;                    // why they are not known
};

/** Null while the metadata are not known. Throws what makeDecoder throws. */
std::shared_ptr<const PacketDecoder> decoderOf(const RigSensor&);

/**
 * Where its packets arrive: on its topics of a bag, or at ports as configured, else as its metadata say; while they are
 * not known, at the default ports of sensors that can be asked. Throws ConfigError if neither the configuration nor its
 * metadata name a port.
 */
LidarAddress addressOf(const RigSensor&, const PacketDecoder*);

enum class MetadataNeed
{
  OfAll,   // captures: a lidar can't join later
  OfSome,  // live: the other lidars join when their sensors answer
};

/**
 * Asks all sensors without metadata at the same time and adds their metadata, or why there are none. Throws ConfigError
 * with every failure if the need is not met (a sensor that is starting counts as one that will answer), and what
 * metadataOf throws.
 */
void askForMetadata(std::vector<RigSensor>&, MetadataNeed);
}  // namespace scanloom
