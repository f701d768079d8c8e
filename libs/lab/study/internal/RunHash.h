/** What tells whether a run is still the same. */
#pragma once
#include "lab/study/ExperimentPlan.h"

#include <string>

namespace scanloom
{
/**
 * 32 hexadecimal digits from everything that the result of a run depends on: version of the program, label, settings,
 * content of the configurations and of the simulation's file; of a recording and its reference the names and sizes of
 * the files.
 */
std::string configurationHash(const PlannedRun&, const ExperimentPlan&, const std::string& version);
}  // namespace scanloom
