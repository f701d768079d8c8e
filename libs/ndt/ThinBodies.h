/** Corrects points of stems, poles and posts from the side that a lidar sees to their axes. */
#pragma once
#include "ndt/CellBins.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace scanloom
{
/**
 * Moves the points of every cell that holds a thin body onto the body's axis.
 *
 * A lidar sees only the near side of a stem of radius r: the mean of the points lies (pi/4) r in front of the axis, and
 * moves along as the lidar passes. Registered against a map of near sides, a drive past stems of 20 cm is measured 0.4
 * % too short. Rays that are spread evenly over a width of 2 r have a sideways variance of r^2 / 3, which the noise of
 * ranges does not change: it gives r, and with r the axis.
 *
 * A cell holds a thin body if its points are at least twice as long as wide, and r is at most 0.3 m. Cells that are
 * seen along their axis stay. A strip of a wall that the grid cuts off is moved, too, in map and scan alike.
 *
 * Two or three points (fewer than `least_points`) show an axis, but no radius. Most stems are so far away that they
 * have no more: without a correction they alone make a drive 0.2 % too short. They get the median radius of the bodies
 * within 8 m, if five of those are measured, and if they stand upright (z is up, roughly).
 */
void moveToAxes(std::vector<Bin>&, std::int64_t cell_quanta, const Eigen::Vector3d& viewpoint, int least_points);
}  // namespace scanloom
