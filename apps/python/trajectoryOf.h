#pragma once
#include "Pose.h"
#include "base/core/StampedPose.h"

#include <algorithm>
#include <vector>

namespace scanloom
{
/** As trajectory.tum: where a drive was found in an earlier map, from there on, in that map's frame. */
inline Trajectory trajectoryOf(const std::vector<Pose>& poses)
{
  Trajectory trajectory;
  auto pose = std::find_if(poses.begin(), poses.end(), [](const Pose& p) { return p.in_map; });
  if (pose == poses.end()) pose = poses.begin();
  for (; pose != poses.end(); ++pose) trajectory.push_back({pose->stamp, pose->map_T_body});
  return trajectory;
}
}  // namespace scanloom
