#include "estimation/slam/ConstantMotion.h"

#include "base/core/So3.h"
#include "estimation/imu/NavState.h"

#include <algorithm>

namespace scanloom
{
void ConstantMotion::update(const StateEstimate& estimate)
{
  const StampedPose now{estimate.stamp, estimate.map_T_body};
  if (latest_)
  {
    // A scan that is deskewed by a wrong rate gives a wrong attitude, and so the next wrong rate: by halves such a
    // swing dies out.
    const Eigen::Vector3d turn = logSo3(latest_->map_T_body.rotation.conjugate() * now.map_T_body.rotation);
    turn_rate_ += 0.5 * (turn / seconds(now.stamp - latest_->stamp) - turn_rate_);
  }
  latest_ = now;
}

void ConstantMotion::enterMap(const Rigid& map_T_drive)
{
  if (latest_) latest_->map_T_body = map_T_drive * latest_->map_T_body;
}

std::vector<ImuSample> ConstantMotion::samplesUntil(Timestamp end)
{
  constexpr std::int64_t kMost = 10'000;  // 100 s: behind it may be the wrong year of a damaged stamp
  const Duration step = std::max<Duration>(10ms, (end - given_.value_or(start_)) / kMost);
  std::vector<ImuSample> samples;
  while (!given_ || *given_ < end)
  {
    given_ = given_ ? std::min(*given_ + step, end) : start_;
    samples.push_back({*given_, turn_rate_, -gravityInMap()});
  }
  return samples;
}
}  // namespace scanloom
