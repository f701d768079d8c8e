/** Rate of an IMU, and gaps between its samples. */
#pragma once
#include "base/core/ImuSample.h"

#include <optional>
#include <vector>

namespace scanloom
{
struct ImuTiming
{
  std::uint64_t samples = 0;
  std::optional<double> rate;   // Hz, from the median interval
  std::uint64_t gaps = 0;       // intervals of more than 2.5 times the median
  std::uint64_t lost = 0;       // samples missing in the gaps
  Duration longest_gap{0};      // largest interval
  std::uint64_t backwards = 0;  // stamps that do not rise
  Timestamp first, last;        // meaningless without samples
};

/** Samples in the order of arrival. */
ImuTiming imuTiming(const std::vector<ImuSample>&);
}  // namespace scanloom
