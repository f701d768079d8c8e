#include "estimation/slam/internal/LidarTrack.h"

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
  constexpr double kMetres = 0.5, kRadians = 0.1;  // a scan that is deskewed by 3 m/s too much is smeared by 0.3 m
  if (!last_step_) return false;
  const Vector6d off = boxMinus(local_T_body, *last_ * *last_step_);
  return off.head<3>().norm() < kMetres && off.tail<3>().norm() < kRadians;
}
}  // namespace scanloom
