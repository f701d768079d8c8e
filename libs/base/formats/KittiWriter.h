/** Clouds of the KITTI odometry benchmark (A. Geiger et al.: Vision meets Robotics, IJRR 2013). */
#pragma once
#include "base/core/PointCloud.h"

#include <filesystem>

namespace scanloom
{
/** float x y z intensity per point, intensity from 0 to 1; no times. Throws std::runtime_error if it cannot be written.
 */
void writeKittiScan(const std::filesystem::path&, const PointCloud&);
}  // namespace scanloom
