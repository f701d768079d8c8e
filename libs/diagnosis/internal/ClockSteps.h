/** Steps of a lidar's clock: its stamps jump while its rotor keeps turning evenly. */
#pragma once
#include "diagnosis/internal/PacketRuns.h"

namespace scanloom
{
struct ClockStep
{
  Timestamp at;      // stamp of the last packet before the step
  Duration size{0};  // added to the clock
};

/**
 * Compares the time between two packets of a run by their stamps with that by their block numbers. Differences below
 * `least` or below 2 % of that time may be the rotor's and are no step.
 */
std::vector<ClockStep> clockSteps(const std::vector<PacketRun>&, const LidarDescription&, Duration least);

/** When a packet was measured and when it arrived. */
struct Arrival
{
  Timestamp stamp;  // of its last valid block, on the lidar's clock as it is after the last step
  Timestamp received;

  Duration delay() const { return received - stamp; }
};

/** Packets with a valid block of the last run, in the order of arrival. */
std::vector<Arrival> arrivalsOn(const std::vector<PacketRun>&, const LidarDescription&, Duration least_step);
}  // namespace scanloom
