#pragma once
#include "lab/simulation/RecordingOptions.h"
#include "lab/simulation/internal/Scene.h"

#include <cstdint>

namespace scanloom
{
/** Throws UsageError if options that are within their bounds contradict each other. */
Scene checkedScene(const SimulationSettings&, std::uint64_t seed);
}  // namespace scanloom
