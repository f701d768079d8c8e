/** One lidar of a rig, known or not known yet, and what it takes to ask it again. */
#pragma once
#include "lidar/PacketDecoder.h"
#include "source/LidarMetadata.h"
#include "source/PacketRouter.h"

#include <memory>

namespace scanloom
{
struct RigSensor
{
  LidarOptions options;
  Rigid body_T_sensor;
  std::optional<LidarSensor> sensor;      // none: its metadata are in a file
  std::optional<LidarMetadata> metadata;  // none: not known yet
  std::string failure;                    // then: why
};

/** Null while the metadata are not known. Throws what makeDecoder throws. */
std::shared_ptr<const PacketDecoder> decoderOf(const RigSensor&);

/**
 * Where its packets arrive: as configured, else as its metadata say, else at the maker's usual ports while they are not
 * known. Throws ConfigError if its metadata name no port and the configuration neither.
 */
LidarAddress addressOf(const RigSensor&, const PacketDecoder*);

enum class MetadataNeed
{
  OfAll,   // recorded packets: nobody can join later
  OfSome,  // live: the others join when they answer
};

/**
 * Asks all sensors at once and adds what they say, or why they do not. Throws ConfigError with every failure if the
 * need is not met (a sensor that is starting counts as one that will answer), and what metadataOf throws.
 */
void askForMetadata(std::vector<RigSensor>&, MetadataNeed);
}  // namespace scanloom
