#include "input/batching/internal/SlidingMinimum.h"

#include <algorithm>

namespace scanloom
{
void SlidingMinimum::add(Timestamp when, Duration value)
{
  if (!rising_.empty()) when = std::max(when, rising_.back().when);
  while (!rising_.empty() && rising_.back().value >= value) rising_.pop_back();
  rising_.push_back({when, value});
  while (rising_.front().when < when - span_) rising_.pop_front();
}

void SlidingMinimum::shift(Duration by)
{
  for (Value& v : rising_) v.value += by;
}
}  // namespace scanloom
