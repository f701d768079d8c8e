#include "diagnosis/internal/SensorFlags.h"

#include <algorithm>

namespace scanloom
{
SensorFlags sensorFlags(const std::vector<PacketTrace>& packets)
{
  SensorFlags flags;
  for (const PacketTrace& packet : packets)
  {
    flags.alert_packets += packet.alert_flags != 0 ? 1 : 0;
    flags.alerts |= packet.alert_flags;
    flags.thermal_packets += packet.thermal_status != 0 ? 1 : 0;
    flags.shot_limiting_packets += packet.shot_limiting_status != 0 ? 1 : 0;
    flags.worst_thermal_status = std::max(flags.worst_thermal_status, packet.thermal_status);
    flags.worst_shot_limiting_status = std::max(flags.worst_shot_limiting_status, packet.shot_limiting_status);
  }
  return flags;
}
}  // namespace scanloom
