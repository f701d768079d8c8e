#pragma once
#include "diagnosis/internal/RigEvidence.h"
#include "input/rig/SensorInput.h"

#include <functional>

namespace scanloom
{
/**
 * IMU samples and some scans of a rawlog or of clouds, which hold no packets; up to the end of the input, or as long as
 * `keep_reading` says. Throws what the input throws.
 */
RigEvidence scanEvidence(SensorInput&, bool poses_known, const std::function<bool()>& keep_reading);
}  // namespace scanloom
