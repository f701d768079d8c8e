/** How well what two lidars saw agrees, as a person would judge it. */
#pragma once
#include "calibration/internal/StationMaps.h"

namespace scanloom
{
struct MountFit
{
  double shared = 0;    // share of the lidar's points that are where the reference saw something
  double distance = 0;  // m, surfaceDistance
};

/** With cells of 1 m, whatever they hold. */
MountFit mountFit(const std::vector<Station>&, const Mount&, const Trajectory&);
}  // namespace scanloom
