/** Widens cells by what lies between the rings of a lidar. */
#pragma once
#include "estimation/ndt/View.h"

namespace scanloom
{
/**
 * Raises the variance of a cell's points across the rings (perpendicular to the view, in the plane of the view and
 * the lidar's axis) to that of an even spread over the spacing of the rings there, or over the cell if that is smaller.
 *
 * Far from a lidar a cell holds the points of one ring. On a wall they are a level line, which is where the ring is,
 * not where something in the world is: as the lidar drives on, the lines of the wall ahead sink or rise, and cells that
 * are thin across them resist. In a flat hall 16 beams lean by 0.1 to 0.4 deg for it, and are surer of that than the
 * accelerometer; within 30 m of way the body is a metre too high, or lost. Widened, they leave the tilt to the IMU
 * (doc/study/localisation.md#between-the-rings).
 */
Bin widenedAcrossRings(const Bin&, const MeanAndCovariance&, const Sight&, const Rings&);
}  // namespace scanloom
