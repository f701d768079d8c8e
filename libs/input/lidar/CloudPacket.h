/** A cloud whose points have stamps of their own, as one packet: what is left of lidars whose packets were not kept. */
#pragma once
#include "input/lidar/PacketDecoder.h"

#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
struct TimedPoint
{
  Timestamp stamp;
  float x = 0, y = 0, z = 0;  // m, in the sensor's frame
  std::uint8_t intensity = 0, ring = 0;
};

/**
 * A packet in the order of stamps; points without finite coordinates or at the origin are left out. A cloud with more
 * than 4096 different stamps has points of several stamps in each measurement block.
 */
std::vector<std::uint8_t> cloudPacket(std::vector<TimedPoint>);

/** What is known of a lidar by its clouds; as JSON {"lidar": "cloud", "rate": 10, "channels": 64}. */
struct CloudMetadata
{
  double rate = 10;  // Hz, 1 to 100: clouds a second, each a turn
  int channels = 1;  // 1 to 256
};

/** Throws std::invalid_argument with file, key and what is expected. */
CloudMetadata parseCloudMetadata(const std::string& text, const std::string& name);
std::string toJson(const CloudMetadata&);

/**
 * A packet is a turn, a block its points of one stamp. A block waits a turn longer than those of other lidars, which
 * the batcher adds to deadline_ms by itself: columns_per_packet is a turn.
 */
std::unique_ptr<PacketDecoder> makeCloudDecoder(const CloudMetadata&, const Rigid& body_T_sensor);
}  // namespace scanloom
