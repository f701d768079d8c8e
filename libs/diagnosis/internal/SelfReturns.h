/** The parts of the machine that its lidars see: points that stay in place in the body frame while the machine drives.
 */
#pragma once
#include "base/core/Finding.h"
#include "calibration/GroundPlane.h"
#include "estimation/preprocessing/Crop.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace scanloom
{
struct SelfReturns
{
  bool known = false;       // false: the machine was in too few places
  double share = 0;         // of the points
  double uncropped = 0;     // of the points: on the machine at all places, and not removed by [crop]
  Eigen::AlignedBox3d box;  // around most of these, in the body frame; empty if there are none
  std::vector<std::vector<std::uint8_t>> marks;  // by turn: 1 where a point is on the machine; empty if not known
};

/**
 * Searches the turns of one lidar, points in the body frame, for cubes of 0.25 m within 12 m that hold points in three
 * quarters of the places where the machine was, and are farther than 0.4 m from the ground plane (flat ground stays in
 * place, too). A turn is in another place than an earlier one if less than half of what it sees farther away and higher
 * than the machine is where it was. Where hardly anything is, each turn counts as a place, and the machine did not move
 * if most points above the ground stay in place.
 */
SelfReturns selfReturns(const std::vector<const PointCloud*>& turns, const std::optional<GroundPlane>&,
                        const Crop& = cropOf({}));

/** Of all lidars of one body, by their numbers of points: shares, one box; without marks. */
SelfReturns together(const std::vector<SelfReturns>&, const std::vector<std::size_t>& points);

/** A warning with the box to set, if much of what the lidars see is the machine and [crop] does not remove it. */
Finding cropFinding(const SelfReturns&);

/** "min_x = -1.1\nmax_x = ..." with this between the keys. Outwards, to 0.1 m. */
std::string cropKeys(const Eigen::AlignedBox3d&, const char* separator);
}  // namespace scanloom
