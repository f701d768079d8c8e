/** What a lidar says about its own health in the headers of its packets. */
#pragma once
#include "dataset/PacketTrace.h"

namespace scanloom
{
struct SensorFlags
{
  std::uint64_t alert_packets = 0;                                        // with any alert flag
  std::uint8_t alerts = 0;                                                // all flags that were seen, by their bits
  std::uint64_t thermal_packets = 0, shot_limiting_packets = 0;           // in a state other than normal
  std::uint8_t worst_thermal_status = 0, worst_shot_limiting_status = 0;  // the largest code
};

SensorFlags sensorFlags(const std::vector<PacketTrace>&);
}  // namespace scanloom
