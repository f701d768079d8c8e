#pragma once
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/RecordingHeader.h"

namespace scanloom
{
/** ns, what the floats of `t` lose where scans become longer. */
inline constexpr const char* kRestField = "t_rest";

/**
 * Scans at another rate (Hz): windows of one period from the first scan's start on, each with the points measured
 * within, empty if there were none; where the input lacks scans, so does the output. Every label for itself; slices,
 * which scans hold again, go. A window comes out with the scan that completes it. Back at
 * the old rate the scans have the same bytes where one rate is a multiple of the other, and the whole rawlog has if the
 * rate was higher in between; if it was lower, scans come after samples that they came before. Throws
 * std::invalid_argument if the header does not say the rate, and for clouds without t.
 */
RawlogOperation rebatch(double scan_rate, const RecordingHeader&);
}  // namespace scanloom
