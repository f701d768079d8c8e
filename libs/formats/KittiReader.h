/** Clouds of the KITTI odometry benchmark (A. Geiger et al.: Vision meets Robotics, IJRR 2013). */
#pragma once
#include "core/Bytes.h"

#include <Eigen/Core>

#include <vector>

namespace scanloom
{
/** Of a file in memory: float x y z intensity per point. Throws std::invalid_argument if the last point is cut. */
std::vector<Eigen::Vector3f> kittiPositions(Bytes file);
}  // namespace scanloom
