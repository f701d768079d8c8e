/** What a person should know of the lidars while packets are batched; nothing is printed here. */
#pragma once
#include "input/batching/RoutedPacket.h"

#include <cstdint>
#include <string>

namespace scanloom
{
struct Notice
{
  enum class Kind
  {
    Silent,        // a scan was closed without a block of this lidar, after its deadline
    Back,          // its packets come again; duration: how long none came
    Restarted,     // the sensor has started again
    ClockStepped,  // its clock jumped; duration: by how much
    ClockAligned,  // it does not share the others' clock; duration: added to its stamps, from times of arrival
    ClockDrifts,   // against the others; duration: by how much since the start or the last such notice
    Quarantined,   // it does not share the others' clock and is left out; duration: how far ahead its clock is
    Alert,         // its flags have changed: alerts, heat or fewer shots
    QueueFull,     // more packets wait than allowed: the oldest are dropped
  };

  Kind kind = Kind::Silent;
  LidarIndex lidar = 0;
  Timestamp when;  // host time, or record time of the capture
  Duration duration{0};
  std::uint32_t flags = 0;  // alert_flags | thermal_status << 8 | shot_limiting_status << 16
};

/** One line for a log: "lidar 'left': ...". */
std::string textOf(const Notice&, const std::string& lidar);
}  // namespace scanloom
