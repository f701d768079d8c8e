#pragma once
#include "lab/simulation/internal/Scene.h"

namespace scanloom
{
/** The lidars of the settings. Throws std::invalid_argument that names a wrong option. */
std::vector<LidarStation> makeLidarStations(const SimulationSettings&, const RecordingSpan&, std::uint64_t seed);
}  // namespace scanloom
