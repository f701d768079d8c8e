/** Widens cells by what lies between the rings of a lidar. */
#pragma once
#include "estimation/ndt/View.h"

#include <optional>

namespace scanloom
{
/** What the points of a block of cells lie on. */
struct SurfaceOfBlock
{
  std::optional<Eigen::Vector3d> normal;  // of a plane
  bool is_line = false;                   // of a single ring: the surface may have any slope across it

  bool isKnown() const { return normal || is_line; }
};

/** `bins`: those of a block of 4 x 4 x 4 cells of `edge` (m), from `first` to before `last`. */
SurfaceOfBlock surfaceOf(const Bin* first, const Bin* last, double edge);

/**
 * Raises the variance of a cell's points along the surface, from a ring to the next, to that of an even spread over the
 * gap between the rings there, or over the cell if that is smaller. Of what is no plane the surface is taken to face
 * the lidar: across the rings is then perpendicular to the view, in the plane of the view and the lidar's axis.
 *
 * Far from a lidar a cell holds the points of one ring. On a wall they are a level line, which is where the ring is,
 * not where something in the world is: as the lidar drives on, the lines of the wall ahead sink or rise, and cells that
 * are thin across them resist. In a flat hall 16 beams lean by 0.1 to 0.4 deg for it, and are surer of that than the
 * accelerometer; within 30 m of way the body is a metre too high, or lost. On bare ground the rings move with the
 * lidar, and hold it where it was. Widened, they leave tilt and way to the IMU
 * (doc/study/localisation.md#between-the-rings).
 */
Bin widenedAcrossRings(const Bin&, const MeanAndCovariance&, const Sight&, const Rings&, const SurfaceOfBlock& = {});
}  // namespace scanloom
