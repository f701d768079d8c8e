#pragma once
#include "Pose.h"
#include "base/core/StampedPose.h"

#include <vector>

namespace scanloom
{
inline Trajectory trajectoryOf(const std::vector<Pose>& poses)
{
  Trajectory trajectory;
  for (const Pose& pose : poses) trajectory.push_back({pose.stamp, pose.map_T_body});
  return trajectory;
}
}  // namespace scanloom
