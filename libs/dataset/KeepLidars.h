#pragma once
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/RecordingHeader.h"

#include <string>
#include <vector>

namespace scanloom
{
/**
 * The points of some lidars only, numbered anew in the header's order; the header names them alone. Parts
 * `lidar_<name>` and samples `imu_<name>` of the others go. Throws UsageError for a name that no lidar has.
 */
RawlogOperation keepLidars(const std::vector<std::string>& names, const RecordingHeader&);
}  // namespace scanloom
