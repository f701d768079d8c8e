/** What a person should hear of while packets are batched; nothing is printed here. */
#pragma once
#include "core/Time.h"

#include <cstdint>
#include <string>

namespace scanloom
{
using LidarIndex = std::size_t;

struct Notice
{
  enum class Kind
  {
    Silent,        // a scan was closed without waiting for it any longer
    Back,          // it is heard again; duration: how long it was silent
    Restarted,     // it has begun anew
    ClockStepped,  // its clock jumped; duration: by how much
    ClockAligned,  // its clock is another one: duration is what is added to its stamps, from times of arrival
    ClockDrifts,   // against the others; duration: by how much since the start
    Quarantined,   // its clock is another one, and the configuration wants it left out; duration: how far off
    Alert,         // it reports alerts, heat or fewer shots; flags
    QueueFull,     // more packets wait than allowed: the oldest are dropped
  };

  Kind kind = Kind::Silent;
  LidarIndex lidar = 0;
  Timestamp when;  // host time
  Duration duration{0};
  std::uint32_t flags = 0;  // alert_flags | thermal_status << 8 | shot_limiting_status << 16
};

/** One line for a log: "lidar 'left': ...". */
std::string textOf(const Notice&, const std::string& lidar);
}  // namespace scanloom
