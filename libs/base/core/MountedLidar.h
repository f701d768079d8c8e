#pragma once
#include "base/core/Rigid.h"

#include <string>
#include <vector>

namespace scanloom
{
/** Name of a lidar and its pose on the body. */
struct MountedLidar
{
  std::string name;
  Rigid body_T_sensor;
};

std::vector<Rigid> posesOf(const std::vector<MountedLidar>&);
}  // namespace scanloom
