#pragma once
#include "input/ros2/Ros2Node.h"

#include <string>

namespace scanloom
{
/**
 * Cyclone's configuration: what the environment says overrides ours.
 * - A writer never waits for a reader: the watermark is above all that it keeps.
 * - A scan is ten times what the kernel keeps for a socket by default, so some of its fragments get lost on the way to
 *   a reader of this computer already. Fragments as long as a message, instead of ten in each, let a reader follow;
 *   heartbeats every 10 ms, instead of 100, let it ask for what it lacks before the next scan. With Cyclone's defaults
 *   19 of 111 scans reached a Fast DDS with its own defaults, with these 111 (tests/end_to_end/ros2.sh).
 * - Up to 32 programs of a computer find each other without multicast, as in ROS 2.
 */
std::string configurationOf(const Ros2Network&);
}  // namespace scanloom
