#pragma once
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"

namespace scanloom
{
/** What rounding to the float `t` loses where scans become longer, in ns. */
inline constexpr const char* kRestField = "t_rest";

/**
 * Scans at another rate (Hz): windows of one period, counted from the first scan's start, each with the points measured
 * within it. A window without points is an empty cloud; where the input has no scans there are no windows. Labels are
 * treated separately. Slices are removed, since the scans hold the same points. A window comes out with the scan that
 * completes it.
 *
 * Going to another rate and back gives the same scans to the byte if one rate is a multiple of the other. The whole
 * rawlog is then the same if the rate in between was higher; if it was lower, some scans come after IMU samples that
 * they preceded.
 *
 * Throws std::invalid_argument if the header does not name the rate, and for clouds without t.
 */
RawlogOperation rebatch(double scan_rate, const RecordingHeader&);
}  // namespace scanloom
