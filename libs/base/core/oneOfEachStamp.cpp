#include "base/core/oneOfEachStamp.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace scanloom
{
std::optional<std::string> ImuOfEachStamp::leftOut() const
{
  std::vector<std::string> parts;
  if (conflicts > 0)
    parts.push_back(fmt::format("{} of {} samples have the stamp of another one, with other values: left out",
                                conflicts, samples.size() + copies + conflicts));
  else if (copies > 0)
    parts.push_back(fmt::format("{} samples are there twice: left out", copies));
  if (unreadable > 0) parts.push_back(fmt::format("{} messages cannot be read: left out", unreadable));
  if (parts.empty()) return std::nullopt;
  return fmt::format("{}", fmt::join(parts, "; "));
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
