#include "estimation/imu/ImuBuffer.h"

#include "estimation/imu/internal/ImuStep.h"

#include <algorithm>

namespace scanloom
{
namespace
{
bool isBefore(const ImuSample& sample, Timestamp stamp) { return sample.stamp < stamp; }
bool isAfter(Timestamp stamp, const ImuSample& sample) { return stamp < sample.stamp; }

ImuSample sampleAt(const std::deque<ImuSample>& samples, Timestamp stamp)
{
  const auto next = std::lower_bound(samples.begin(), samples.end(), stamp, isBefore);
  if (next == samples.begin()) return {stamp, next->gyro, next->accel};
  if (next == samples.end()) return {stamp, samples.back().gyro, samples.back().accel};
  return interpolate(*std::prev(next), *next, stamp);
}
}  // namespace

ImuBuffer::ImuBuffer(const std::vector<ImuSample>& samples)
{
  for (const ImuSample& sample : samples) add(sample);
}

bool ImuBuffer::add(const ImuSample& sample)
{
  if (!samples_.empty() && sample.stamp <= samples_.back().stamp) return false;
  if (!sample.gyro.allFinite() || !sample.accel.allFinite()) return false;
  samples_.push_back(sample);
  return true;
}

bool ImuBuffer::covers(Timestamp from, Timestamp to) const
{
  return !samples_.empty() && samples_.front().stamp <= from && to <= samples_.back().stamp;
}

bool ImuBuffer::coversDensely(Timestamp from, Timestamp to, Duration widest) const
{
  auto next = std::upper_bound(samples_.begin(), samples_.end(), from, isAfter);
  Timestamp reached = next == samples_.begin() ? from : std::prev(next)->stamp;
  for (; next != samples_.end() && reached < to; ++next)
  {
    if (next->stamp - reached > widest) return false;
    reached = next->stamp;
  }
  return !samples_.empty() && to - reached <= widest;
}

std::vector<ImuSample> ImuBuffer::between(Timestamp from, Timestamp to) const
{
  if (samples_.empty() || to <= from) return {};
  const auto first = std::upper_bound(samples_.begin(), samples_.end(), from, isAfter);
  const auto last = std::lower_bound(first, samples_.end(), to, isBefore);

  std::vector<ImuSample> cut;
  cut.reserve(static_cast<std::size_t>(last - first) + 2);
  cut.push_back(sampleAt(samples_, from));
  cut.insert(cut.end(), first, last);
  cut.push_back(sampleAt(samples_, to));
  return cut;
}

void ImuBuffer::forgetBefore(Timestamp from)
{
  // The last sample at or before `from` stays: the reading at `from` is interpolated from it.
  const auto next = std::upper_bound(samples_.begin(), samples_.end(), from, isAfter);
  if (next != samples_.begin()) samples_.erase(samples_.begin(), std::prev(next));
}
}  // namespace scanloom
