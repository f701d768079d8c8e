/** A lidar's packets, each with its place among all that the lidar sent since it was started. */
#pragma once
#include "dataset/PacketTrace.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
struct NumberedPacket
{
  std::int64_t block = 0;   // of PacketTrace::measurement_id, counted over all turns
  std::int64_t packet = 0;  // counted over all turns and within the azimuth window only: the next one sent is 1 higher
  const PacketTrace* trace = nullptr;
};

/** From one start of the lidar to the next, in the order of arrival. */
using PacketRun = std::vector<NumberedPacket>;

/**
 * By Numbering::Ids, a lidar has started again where its init id changes, and where its ids jump by more than four
 * turns, unless the stamps went on by as much: then packets were lost. By Numbering::Stamps there is one run: blocks
 * follow the rotor's column, packets the stamps at their regular distance; where the stamps jump against the arrival by
 * more than 0.5 s, the clock was set and the arrival counts. The result points into `traces`.
 */
std::vector<PacketRun> packetRuns(const std::vector<PacketTrace>& traces, const LidarDescription&);
}  // namespace scanloom
