#include "base/core/StampedPose.h"

#include <algorithm>
#include <iterator>

namespace scanloom
{
std::optional<Rigid> poseAt(const Trajectory& trajectory, Timestamp stamp, Duration widest)
{
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), stamp,
                                      [](const StampedPose& pose, Timestamp t) { return pose.stamp < t; });
  if (after == trajectory.end()) return std::nullopt;
  if (after->stamp == stamp) return after->map_T_body;
  if (after == trajectory.begin()) return std::nullopt;

  const auto before = std::prev(after);
  if (after->stamp - before->stamp > widest) return std::nullopt;
  const double share = seconds(stamp - before->stamp) / seconds(after->stamp - before->stamp);
  return interpolate(before->map_T_body, after->map_T_body, share);
}
}  // namespace scanloom
