/** Whether the poses of two lidars on the body fit what both see; `scanloom doctor` and `scanloom slam` say it alike.
 */
#pragma once
#include "base/core/Finding.h"
#include "calibration/CloudAgreement.h"

#include <optional>
#include <string>

namespace scanloom
{
/**
 * About `lidar`, if the pose of `other` is right. Four standard deviations are subtracted from an error before it is
 * compared with the limits, and it counts only if the registration fits clearly better without it: along a street a
 * movement changes little. How many points agree to 0.3 m does not tell: in a corridor they do so with 3 deg of error.
 */
Finding poseFinding(const std::string& lidar, const std::string& other, const std::optional<CloudAgreement>&);

/**
 * About a lidar alone: whether what it sees stays in place while the machine drives. A lidar that is mounted the other
 * way round turns against the body, and one with another's beam angles bends the ground.
 */
Finding steadinessFinding(const std::string& lidar, const std::optional<OverlapOverTurns>& on_the_way);
}  // namespace scanloom
