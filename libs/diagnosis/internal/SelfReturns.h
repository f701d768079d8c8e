/** The parts of the machine that a lidar sees: points that stay in place in the body frame while the machine drives. */
#pragma once
#include "calibration/GroundPlane.h"
#include "diagnosis/internal/Snapshots.h"

#include <Eigen/Geometry>

namespace scanloom
{
struct SelfReturns
{
  bool known = false;       // false: the machine stood still, or there are fewer than four snapshots
  double share = 0;         // of the points
  Eigen::AlignedBox3d box;  // around these points in the body frame; empty if there are none
};

/**
 * Searches for cubes of 0.25 m within 12 m that hold points of this lidar in three quarters of the snapshots and are
 * farther than 0.4 m from its ground plane (flat ground stays in place, too). If half of what is farther away and
 * higher than the machine is in place, too, or, where nothing is, most points above the ground are, the machine did not
 * move; otherwise marks these points in the snapshots.
 */
SelfReturns markSelfReturns(std::vector<RigSnapshot>&, std::size_t lidar, const std::optional<GroundPlane>&);
}  // namespace scanloom
