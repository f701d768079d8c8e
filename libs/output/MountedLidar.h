#pragma once
#include "mrpt_bridge/RecordingHeader.h"

namespace scanloom
{
/** What a map needs to know of a lidar. */
struct MountedLidar
{
  std::string name;
  Rigid body_T_sensor;
};

std::vector<MountedLidar> mountedLidars(const std::vector<RecordedLidar>&);

std::vector<Rigid> posesOf(const std::vector<MountedLidar>&);
}  // namespace scanloom
