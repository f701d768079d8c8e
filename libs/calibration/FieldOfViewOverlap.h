/** Whether two lidars look the same way. */
#pragma once
#include "calibration/internal/Stations.h"

namespace scanloom
{
/**
 * Of the directions in which either lidar sees something, 10 deg each about the body's z axis, the share in which both
 * do: 1 for two that see all around, 0 for one that looks ahead and one that looks back; the mean over the stations.
 * To each station only the scans of its own instant may belong.
 */
double commonField(const std::vector<Station>&, const Extrinsics&, const Trajectory&);
}  // namespace scanloom
