/** Numbers a lidar's packets in the order in which the lidar sent them. */
#pragma once
#include "diagnosis/internal/PacketTrace.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
struct NumberedPacket
{
  std::int64_t block = 0;   // number of the block PacketTrace::measurement_id, counted over all turns
  std::int64_t packet = 0;  // number of the packet among those sent, over all turns: the next one sent is 1 higher
  const PacketTrace* trace = nullptr;
};

/** The packets between two starts of the lidar, in the order of arrival. */
using PacketRun = std::vector<NumberedPacket>;

/**
 * With Numbering::Ids a run ends where the init id changes, and where the ids jump by more than four turns unless the
 * stamps advanced by as many turns (then packets were lost). With Numbering::Stamps there is one run: blocks are
 * numbered by the rotor's column and packets by their stamps, which are evenly spaced. Where stamps and arrival times
 * differ by more than 0.5 s the clock was set, and the arrival times count. The result points into `traces`.
 */
std::vector<PacketRun> packetRuns(const std::vector<PacketTrace>& traces, const LidarDescription&);
}  // namespace scanloom
