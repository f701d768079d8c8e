/** Fewer points, evenly distributed. */
#pragma once
#include "base/core/PointCloud.h"

namespace scanloom
{
/** The first point of each cube with this edge (m), in the cloud's order. Throws std::invalid_argument unless edge > 0.
 */
PointCloud thin(PointCloud points, double edge);
}  // namespace scanloom
