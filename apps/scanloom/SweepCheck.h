/** Finds before a sweep starts what its runs would end with. */
#pragma once
#include "base/config/Configuration.h"
#include "lab/study/ExperimentPlan.h"

namespace scanloom
{
/**
 * Reads the settings of every combination, recognises each recording, opens it with each set of lidars, and reads its
 * reference. Of each simulated drive a second is simulated, into a temporary folder.
 * @param given the configuration that the plan was made of.
 * @throws ConfigError with all mistakes, each with the key and the value that cause it.
 */
void refuseMistakes(const ExperimentPlan&, const Configuration& given);
}  // namespace scanloom
