#include "run/run/internal/RigCheck.h"

#include <fmt/format.h>

namespace scanloom
{
void RigCheck::add(const StateEstimate& estimate)
{
  constexpr Duration kPeriod = 60s;
  imu_.add(estimate);
  if (estimate.keyframe) lidars_.add(*estimate.keyframe);
  if (!next_check_) next_check_ = estimate.stamp + kPeriod;
  if (estimate.stamp < *next_check_) return;
  next_check_ = estimate.stamp + kPeriod;
  check();
}

void RigCheck::check()
{
  checkLidars();
  checkImu();
}

void RigCheck::checkLidars()
{
  findings_ = lidars_.compare();
  for (const Finding& finding : findings_)
  {
    if (finding.verdict < Verdict::Warning || !blamed_lidars_.insert(finding.about).second) continue;
    warn_(fmt::format("the lidar '{}': {}: {}", finding.about, finding.says, finding.mend));
  }
}

void RigCheck::checkImu()
{
  agreement_ = imu_.agreement();
  if (warned()) return;
  const std::optional<std::string> complaint = imu_.complaint(agreement_);
  if (!complaint) return;
  warn_("the IMU: " + *complaint);
  imu_blamed_ = true;
}
}  // namespace scanloom
