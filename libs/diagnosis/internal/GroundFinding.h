/** Whether the ground that a lidar sees is below the body; `scanloom doctor` and `scanloom slam` say it alike. */
#pragma once
#include "base/core/Finding.h"
#include "base/core/MountedLidar.h"
#include "calibration/GroundPlane.h"

#include <optional>
#include <string>

namespace scanloom
{
/** "27 % of the points within 12 m are on a plane 2.51 m from the sensor, its normal ": its angle follows. */
std::string groundInWords(const GroundPlane&);

/** About a lidar whose pose in the body is known. */
Finding groundFinding(const MountedLidar&, const std::optional<GroundPlane>&);
}  // namespace scanloom
