#pragma once
#include "input/rig/SensorInput.h"

namespace scanloom
{
/**
 * A line for each lidar of which no block came into a scan, with what became of its packets, and one for each of the
 * senders of most datagrams of no lidar; empty if every lidar gave some.
 */
std::vector<std::string> silentLidars(const RigAccount&);
}  // namespace scanloom
