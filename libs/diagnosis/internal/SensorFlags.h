/** Alerts and states that a lidar reports in the headers of its packets. */
#pragma once
#include "diagnosis/internal/PacketTrace.h"

namespace scanloom
{
struct SensorFlags
{
  std::uint64_t alert_packets = 0;                                        // with any alert flag
  std::uint8_t alerts = 0;                                                // bitwise or of all flags
  std::uint64_t thermal_packets = 0, shot_limiting_packets = 0;           // in a state other than normal
  std::uint8_t worst_thermal_status = 0, worst_shot_limiting_status = 0;  // the largest code
};

SensorFlags sensorFlags(const std::vector<PacketTrace>&);
}  // namespace scanloom
