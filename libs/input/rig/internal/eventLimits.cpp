#include "input/rig/internal/eventLimits.h"

namespace scanloom
{
std::vector<std::size_t> eventLimits(const Rig& rig)
{
  std::vector<std::size_t> limits(std::variant_size_v<SensorEvent>);
  limits[kindOf<Scan>()] = rig.live.scans_waiting;
  limits[kindOf<ScanPart>()] = rig.live.scans_waiting * static_cast<std::size_t>(rig.batcher.slices);
  limits[kindOf<SensorImu>()] = 100'000;
  return limits;
}
}  // namespace scanloom
