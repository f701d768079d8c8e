#pragma once
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"

#include <string>
#include <vector>

namespace scanloom
{
/**
 * Keeps the points of the named lidars and numbers these lidars anew, in the header's order; the header then names only
 * them. Observations `lidar_<name>` and `imu_<name>` of other lidars are removed. Throws UsageError for a name that no
 * lidar has.
 */
RawlogOperation keepLidars(const std::vector<std::string>& names, const RecordingHeader&);
}  // namespace scanloom
