#include "mrpt/sensors/internal/HandedOver.h"

#include <algorithm>

namespace scanloom
{
void HandedOver::add(const mrpt::obs::CObservation::Ptr& observation, Time now)
{
  if (held_.empty()) last_change_ = now;
  held_.push_back(observation);
}

std::size_t HandedOver::held(Time now)
{
  const auto freed = [](const auto& observation) { return observation.expired(); };
  const auto first_freed = std::remove_if(held_.begin(), held_.end(), freed);
  if (first_freed != held_.end()) last_change_ = now;
  held_.erase(first_freed, held_.end());
  return held_.size();
}
}  // namespace scanloom
