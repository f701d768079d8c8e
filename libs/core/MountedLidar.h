#pragma once
#include "core/Rigid.h"

#include <string>
#include <vector>

namespace scanloom
{
/** A lidar by its name, and where it is on the body. */
struct MountedLidar
{
  std::string name;
  Rigid body_T_sensor;
};

std::vector<Rigid> posesOf(const std::vector<MountedLidar>&);
}  // namespace scanloom
