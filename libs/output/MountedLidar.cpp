#include "output/MountedLidar.h"

namespace scanloom
{
std::vector<MountedLidar> mountedLidars(const std::vector<RecordedLidar>& recorded)
{
  std::vector<MountedLidar> lidars;
  for (const RecordedLidar& lidar : recorded) lidars.push_back({lidar.name, lidar.body_T_sensor});
  return lidars;
}

std::vector<Rigid> posesOf(const std::vector<MountedLidar>& lidars)
{
  std::vector<Rigid> poses;
  for (const MountedLidar& lidar : lidars) poses.push_back(lidar.body_T_sensor);
  return poses;
}
}  // namespace scanloom
