/** The ground as a lidar sees it: which way is up by the points alone. */
#pragma once
#include "core/PointCloud.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace scanloom
{
struct GroundPlane
{
  Eigen::Vector3d up;        // unit normal towards the sensor, in the body frame
  double sensor_height = 0;  // m above the plane
  double body_height = 0;    // m of the body's origin above the plane
  double share = 0;          // of the points looked at, within 0.15 m of the plane
};

/**
 * The plane with most points among random triples (M. Fischler, R. Bolles: RANSAC, 1981; fixed seed), then least
 * squares on its points. Looks at one point per 0.25 m cube within 12 m of the sensor, so that near rings do not count
 * more than far ones. A plane that lies as the body frame says the ground does is taken, unless another one has more
 * than twice its points: then the body frame is wrong. None where no plane has a tenth of the points, or 100.
 */
std::optional<GroundPlane> groundPlane(const std::vector<const PointCloud*>& points_in_body,
                                       const Eigen::Vector3d& sensor_in_body);
}  // namespace scanloom
