#include "base/core/MountedLidar.h"

namespace scanloom
{
std::vector<Rigid> posesOf(const std::vector<MountedLidar>& lidars)
{
  std::vector<Rigid> poses;
  for (const MountedLidar& lidar : lidars) poses.push_back(lidar.body_T_sensor);
  return poses;
}
}  // namespace scanloom
