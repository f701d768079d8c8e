#include "run/ImuCheck.h"

namespace scanloom
{
void ImuCheck::add(const StateEstimate& estimate)
{
  constexpr Duration kPeriod = 60s;
  watch_.add(estimate);
  if (!next_check_) next_check_ = estimate.stamp + kPeriod;
  if (estimate.stamp < *next_check_) return;
  next_check_ = estimate.stamp + kPeriod;
  check();
}

void ImuCheck::check()
{
  agreement_ = watch_.agreement();
  if (warned_) return;
  const std::optional<std::string> complaint = watch_.complaint(agreement_);
  if (!complaint) return;
  warn_("the IMU: " + *complaint);
  warned_ = true;
}
}  // namespace scanloom
