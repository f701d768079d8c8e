/** Instants at which a lidar's clock was set: its stamps jump though its rotor does not. */
#pragma once
#include "dataset/PacketRuns.h"

namespace scanloom
{
struct ClockStep
{
  Timestamp at;      // stamp of the last packet before it, in the clock of then
  Duration size{0};  // added to the clock
};

/** Found between packets of one run as the stamps' difference less that of the block count; steps below `least`, and
 *  below 2 % of a gap's length, are not told from the rotor's irregularity. */
std::vector<ClockStep> clockSteps(const std::vector<PacketRun>&, const LidarDescription&, Duration least);

/** One packet's way to us. */
struct Arrival
{
  Timestamp stamp;  // of its last block, moved onto the lidar's clock after its last step
  Timestamp received;

  Duration delay() const { return received - stamp; }
};

/** In the order of arrival, the packets with a valid block. Of a lidar that was started again: since then. */
std::vector<Arrival> arrivalsOn(const std::vector<PacketRun>&, const LidarDescription&, Duration least_step);
}  // namespace scanloom
