/** What a lidar sees of the machine that carries it: what stays where it is though the machine drives. */
#pragma once
#include "dataset/GroundPlane.h"
#include "dataset/Snapshots.h"

#include <Eigen/Geometry>

namespace scanloom
{
struct OwnParts
{
  bool told = false;        // false: the machine stood still, or there are fewer than four snapshots
  double share = 0;         // of the points
  Eigen::AlignedBox3d box;  // around them in the body frame; empty if there are none
};

/**
 * Cubes of 0.25 m within 12 m that hold points of this lidar in three of four snapshots, and are farther than 0.4 m
 * from its ground plane: flat ground stays where it is, too. If that is most of what stands out of the ground, the
 * machine did not move. If it did, marks the points in such cubes in the snapshots.
 */
OwnParts markOwnParts(std::vector<RigSnapshot>&, std::size_t lidar, const std::optional<GroundPlane>&);
}  // namespace scanloom
