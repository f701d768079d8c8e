#pragma once
#include <cstdint>
#include <vector>

namespace scanloom
{
struct Gaps
{
  double usual_interval = 0;  // s, median
  std::uint64_t count = 0;    // intervals longer than so many usual ones
  std::uint64_t missing = 0;  // samples that would fill them
};

/** In a sequence with these intervals (s); an interval is a gap if it is longer than `factor` usual ones. */
Gaps gapsIn(const std::vector<double>& intervals, double factor);
}  // namespace scanloom
