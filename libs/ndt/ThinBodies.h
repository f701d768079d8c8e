/** Stems, poles and posts: where they stand, not where a lidar touches them. */
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
 * A lidar sees the near side of a stem of radius r only: the mean of what it sees lies (pi/4) r before the axis, and
 * comes along as the lidar passes by. Registered against a map of near sides, the way past stems of 20 cm comes out
 * 0.4 % short. Rays spread evenly over a width of 2 r have a variance of r^2 / 3 sideways, where the noise of ranges
 * does not reach: that gives r, and by r the axis.
 *
 * A cell holds a thin body if it has `least_points`, is at least twice as long as wide, and r is 0.3 m at most. Cells
 * seen along their axis stay. A wall that the grid cuts to a strip is moved with them: alike in map and scan.
 */
void moveToAxes(std::vector<Bin>&, std::int64_t cell_quanta, const Eigen::Vector3d& viewpoint, int least_points);
}  // namespace scanloom
