/** How a lidar's clock runs against the recording computer's, from the fastest packets of each while. */
#pragma once
#include "dataset/ClockSteps.h"

#include <optional>

namespace scanloom
{
/** Theil-Sen line through the smallest delay of each of up to 30 windows of equal length. */
struct ClockDrift
{
  double ppm = 0;        // positive: the lidar's clock is fast
  double sigma_ppm = 0;  // standard deviation of that, from the scatter of the minima about the line
};

/** None if the arrivals span less than `shortest`: a drift would be a guess. */
std::optional<ClockDrift> clockDrift(const std::vector<Arrival>&, Duration shortest);

/** One clock against another's, both against the same computer's. */
ClockDrift operator-(const ClockDrift&, const ClockDrift&);

/** Delays as the batcher's deadline sees them: after the lidar's own fastest packets. */
struct ArrivalJitter
{
  Duration least_delay{0};  // arrival minus stamp of the fastest packet; the difference of the clocks is in it
  Duration p50{0}, p99{0}, largest{0};  // above that
};

/** With the drift taken out where it is known; nothing without arrivals. */
std::optional<ArrivalJitter> arrivalJitter(const std::vector<Arrival>&, const std::optional<ClockDrift>&);

/** Share of packets with more jitter than `deadline`. */
double shareBeyond(const std::vector<Arrival>&, const std::optional<ClockDrift>&, Duration deadline);
}  // namespace scanloom
