#include "estimation/imu/ImuScreening.h"

#include <fmt/format.h>

#include <utility>

namespace scanloom
{
std::string RefusedReadings::toString() const
{
  const std::pair<std::uint64_t, const char*> reasons[] = {
      {unusable, "not finite or out of order"},
      {beyond_range, "beyond its range"},
      {spikes, "beyond the reach of their neighbours"},
      {constant, "constant, as if it hung"},
  };
  std::string text;
  for (const auto& [count, reason] : reasons)
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, reason);
  return text;
}

std::vector<ImuSample> ImuScreening::pass(const ImuSample& sample)
{
  const bool in_order = !newest_ || sample.stamp > *newest_;
  if (!in_order || !sample.gyro.allFinite() || !sample.accel.allFinite())
  {
    ++unusable_;
    return {};
  }
  newest_ = sample.stamp;
  std::vector<ImuSample> passed;
  for (const ImuSample& reading : spikes_.pass(sample))
  {
    const std::vector<ImuSample> alive = frozen_.pass(reading);
    passed.insert(passed.end(), alive.begin(), alive.end());
  }
  return passed;
}

RefusedReadings ImuScreening::refused() const
{
  return {unusable_, spikes_.beyondRange(), spikes_.spikes(), frozen_.refused()};
}
}  // namespace scanloom
