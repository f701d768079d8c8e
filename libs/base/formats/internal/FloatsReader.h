/** Clouds of bare floats, as KITTI (A. Geiger et al.: Vision meets Robotics, IJRR 2013) and nuScenes have them. */
#pragma once
#include "base/core/Bytes.h"
#include "base/formats/internal/CloudPoints.h"

namespace scanloom
{
/**
 * Of a file in memory: x y z in m first in each point of three to seven floats; how many follows from the numbers.
 * Throws std::invalid_argument if the last point is cut, or if the numbers are no coordinates.
 */
CloudPoints pointsOfFloats(Bytes file);
}  // namespace scanloom
