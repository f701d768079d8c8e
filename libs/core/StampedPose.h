#pragma once
#include "core/Rigid.h"
#include "core/Time.h"

#include <vector>

namespace scanloom
{
/** Where the body was at an instant. */
struct StampedPose
{
  Timestamp stamp;
  Rigid map_T_body;
};

/** Stamps rise strictly. */
using Trajectory = std::vector<StampedPose>;
}  // namespace scanloom
