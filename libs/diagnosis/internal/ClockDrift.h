/** Rate of a lidar's clock against the recording computer's, and how evenly the lidar's packets arrive. */
#pragma once
#include "diagnosis/internal/ClockSteps.h"

#include <optional>

namespace scanloom
{
/** From a Theil-Sen line through the smallest delay in each of up to 30 time windows of equal length. */
struct ClockDrift
{
  double ppm = 0;        // positive: the lidar's clock is fast
  double sigma_ppm = 0;  // standard deviation, from the scatter of the smallest delays about the line
};

/** None if the arrivals span less than `shortest`. */
std::optional<ClockDrift> clockDrift(const std::vector<Arrival>&, Duration shortest);

/** Drift of one lidar's clock against another's, from the drifts of both against the computer's. */
ClockDrift operator-(const ClockDrift&, const ClockDrift&);

/** Delays of packets above that of the fastest one, which is what the batcher's deadline limits. */
struct ArrivalJitter
{
  Duration p50{0}, p99{0}, largest{0};
  double late_share = 0;  // of the packets: delay above the deadline
};

/** Without the effect of the drift if that is known; none without arrivals. */
std::optional<ArrivalJitter> arrivalJitter(const std::vector<Arrival>&, const std::optional<ClockDrift>&,
                                           Duration deadline);
}  // namespace scanloom
