#include "diagnosis/internal/Gaps.h"

#include "base/core/Statistics.h"

#include <cmath>

namespace scanloom
{
Gaps gapsIn(const std::vector<double>& intervals, double factor)
{
  Gaps gaps;
  if (intervals.empty()) return gaps;
  gaps.usual_interval = median(intervals);
  for (const double interval : intervals)
  {
    if (gaps.usual_interval <= 0 || interval <= factor * gaps.usual_interval) continue;
    ++gaps.count;
    gaps.missing += static_cast<std::uint64_t>(std::lround(interval / gaps.usual_interval)) - 1;
  }
  return gaps;
}
}  // namespace scanloom
