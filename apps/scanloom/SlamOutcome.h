/** How good the result of a localisation is: for the program's exit status, and for the Python module. */
#pragma once
#include "run/run/SlamRun.h"

#include <cstddef>
#include <string>

namespace scanloom
{
/** The result where sensors of the recording could not be used: SENSOR MISSING, unless something else is wrong. */
SlamRunResult withSensorsNotUsed(SlamRunResult, std::size_t not_used);

/** The run passed, and its input was read whole; otherwise the program ends with status 3. */
bool isGood(const SlamRunResult&);

/** How many poses are not OK: "3 poses INITIALISING, 0 DEGENERATE, 0 LOST"; empty if all are. */
std::string unsoundPoses(const RunSummary&);

/** How many scans of live lidars were dropped, and what helps; empty if none were. */
std::string droppedScans(const RunSummary&);
}  // namespace scanloom
