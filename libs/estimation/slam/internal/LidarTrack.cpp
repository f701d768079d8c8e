#include "estimation/slam/internal/LidarTrack.h"

#include "estimation/ndt/FittedConstants.h"

namespace scanloom
{
void LidarTrack::add(const Rigid& local_T_body)
{
  if (last_) last_step_ = last_->inverse() * local_T_body;
  last_ = local_T_body;
}

void LidarTrack::clear() { *this = {}; }

bool LidarTrack::goesOnTo(const Rigid& local_T_body) const
{
  if (!last_step_) return false;
  const Vector6d off = boxMinus(local_T_body, *last_ * *last_step_);
  return off.head<3>().norm() < fitted::kSameStep && off.tail<3>().norm() < fitted::kSameStepRadians;
}
}  // namespace scanloom
