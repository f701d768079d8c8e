#include "base/core/oneOfEachStamp.h"

#include <fmt/format.h>

namespace scanloom
{
std::optional<std::string> ImuOfEachStamp::leftOut() const
{
  if (conflicts > 0)
    return fmt::format("{} of {} samples have the stamp of another one, with other values: left out", conflicts,
                       samples.size() + copies + conflicts);
  if (copies > 0) return fmt::format("{} samples are there twice: left out", copies);
  return std::nullopt;
}

ImuOfEachStamp oneOfEachStamp(const std::vector<ImuSample>& samples)
{
  ImuOfEachStamp one;
  for (const ImuSample& sample : samples)
  {
    if (one.samples.empty() || sample.stamp != one.samples.back().stamp)
      one.samples.push_back(sample);
    else if (sample.gyro == one.samples.back().gyro && sample.accel == one.samples.back().accel)
      ++one.copies;
    else
      ++one.conflicts;
  }
  return one;
}
}  // namespace scanloom
