/** The ground, and the parts of the machine, in the scans of one lidar. */
#pragma once
#include "base/core/StampedPose.h"
#include "calibration/GroundPlane.h"
#include "calibration/internal/LidarScans.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** By ten scans, in the frame of `body_T_sensor`; planes near level by `up` (unit, in that frame) are preferred. */
std::optional<GroundPlane> groundOf(const std::vector<LidarScan>&, const Rigid& body_T_sensor,
                                    const Eigen::Vector3d& up_in_body);

/**
 * The scans without OwnParts within 5 m: both lidars see such parts at every place, wherever it is, so that they fit
 * best where they were seen and not where they are. Farther away a wall along the way would stay in place as well.
 * Nothing is left out of fewer than eight places 1 m apart. Scans of which nothing is left are left out.
 */
std::vector<LidarScan> withoutOwnParts(std::vector<LidarScan>, const Trajectory&, const Eigen::Vector3d& up_in_lidar);
}  // namespace scanloom
