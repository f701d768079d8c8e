#pragma once
#include "simulation/Scene.h"

namespace scanloom
{
/** The lidars of the settings: units, clocks and faults. Throws std::invalid_argument naming the option that cannot be.
 */
std::vector<LidarStation> makeLidarStations(const SimulationSettings&, const RecordingSpan&, std::uint64_t seed);
}  // namespace scanloom
