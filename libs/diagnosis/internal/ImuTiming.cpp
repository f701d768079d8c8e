#include "diagnosis/internal/ImuTiming.h"

#include "diagnosis/internal/Gaps.h"

#include <algorithm>

namespace scanloom
{
ImuTiming imuTiming(const std::vector<ImuSample>& samples)
{
  ImuTiming timing;
  timing.samples = samples.size();
  if (samples.empty()) return timing;

  timing.first = timing.last = samples.front().stamp;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < samples.size(); ++i)
  {
    const Duration interval = samples[i].stamp - samples[i - 1].stamp;
    timing.first = std::min(timing.first, samples[i].stamp);
    timing.last = std::max(timing.last, samples[i].stamp);
    timing.longest_gap = std::max(timing.longest_gap, interval);
    if (interval <= Duration{0})
      ++timing.backwards;
    else
      intervals.push_back(seconds(interval));
  }
  if (intervals.empty()) return timing;
  const Gaps gaps = gapsIn(intervals, 2.5);
  timing.rate = 1 / gaps.usual_interval;
  timing.gaps = gaps.count;
  timing.lost = gaps.missing;
  return timing;
}
}  // namespace scanloom
