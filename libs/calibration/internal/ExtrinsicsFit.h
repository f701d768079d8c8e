/** How well what two lidars saw agrees, as a person would judge it. */
#pragma once
#include "calibration/internal/StationMaps.h"

namespace scanloom
{
struct ExtrinsicsFit
{
  double shared = 0;    // share of the lidar's points that are where the reference saw something
  double distance = 0;  // m, surfaceDistance
};

/** With cells of 1 m, whatever they hold. */
ExtrinsicsFit extrinsicsFit(const std::vector<Station>&, const Extrinsics&, const Trajectory&);

/** Whether other extrinsics are as likely by what the lidars saw: 80 % of the share, and 1.5 times the distance, or
 * better.
 */
bool fitsAsWell(const ExtrinsicsFit& other, const ExtrinsicsFit& best);

/**
 * surfaceDistance between every second view of the reference and the others (m): by the noise, the size of the cells,
 * the error of the path and leaves alone. 0 where no station has two views.
 */
double distanceWithinReference(const std::vector<Station>&);
}  // namespace scanloom
