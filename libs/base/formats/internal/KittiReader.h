/** Clouds of the KITTI odometry benchmark (A. Geiger et al.: Vision meets Robotics, IJRR 2013). */
#pragma once
#include "base/core/Bytes.h"
#include "base/formats/internal/CloudPoints.h"

namespace scanloom
{
/** Of a file in memory: float x y z intensity per point. Throws std::invalid_argument if the last point is cut. */
CloudPoints kittiPoints(Bytes file);
}  // namespace scanloom
