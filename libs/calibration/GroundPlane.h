/** The ground plane in the points of a lidar, and so the direction of up without an IMU. */
#pragma once
#include "base/core/PointCloud.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace scanloom
{
struct GroundPlane
{
  Eigen::Vector3d up;          // unit normal towards the sensor, in the body frame
  double sensor_height = 0;    // m above the plane
  double body_height = 0;      // m of the body's origin above the plane
  double share = 0;            // of the points used: within 0.15 m of the plane
  bool may_be_a_wall = false;  // it stands upright in the body frame, and a level plane has a tenth of the points, too

  /** Height above the plane (m) of a point in the body frame. */
  double heightOf(const Eigen::Vector3d& p) const { return up.dot(p) + body_height; }
};

/**
 * The plane with most points among those through random triples (M. Fischler, R. Bolles: RANSAC, 1981; fixed seed),
 * then least squares on its points. Uses one point per 0.25 m cube within 12 m of the sensor, so that near rings do not
 * outweigh far ones. Planes that are nearly level in the body frame are preferred, first those below the sensor, unless
 * another plane has more than twice the points: then the pose is wrong. None if no plane has 100 points and a tenth of
 * all. Where only a ceiling is seen, it looks like the ground of a lidar that hangs upside down.
 */
std::optional<GroundPlane> groundPlane(const std::vector<const PointCloud*>& points_in_body,
                                       const Eigen::Vector3d& sensor_in_body);
}  // namespace scanloom
