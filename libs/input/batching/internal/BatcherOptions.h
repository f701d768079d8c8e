#pragma once
#include "base/core/Field.h"
#include "base/core/Time.h"
#include "input/lidar/PacketDecoder.h"

#include <memory>
#include <string>

namespace scanloom
{
/** A lidar as the batcher sees it. Its index in the list is the sensor_id of its points (at most 256 lidars). */
struct BatchedLidar
{
  std::string name;
  std::shared_ptr<const PacketDecoder> decoder;  // null: not known yet, see TimeBatcher::replace
  Duration time_offset{0};                       // added to its stamps
};

struct BatcherOptions
{
  double scan_rate = 10.0;
  double scan_phase_ms = 0.0;
  int slices = 1;
  double deadline_ms = 5.0;
  std::string other_clock = "align";
  int queue_packets = 1024;  // most packets that wait per lidar; above it the oldest is dropped and counted

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.scan_rate,
          Field{"scan_rate", "Hz", "scans per second, independent of the lidars' rotation rates", between(0.1, 1000)});
    visit(o.scan_phase_ms,
          Field{"scan_phase_ms", "ms", "scans start at multiples of the period plus this", between(0, 10000)});
    visit(o.slices,
          Field{"slices", "",
                "number of parts of a scan that are given out before the scan, each as soon as it is complete",
                between(1, 1000)});
    visit(o.deadline_ms, Field{"deadline_ms", "ms",
                               "longest wait for a lidar: how much later than its quickest packets a packet may arrive",
                               between(0, 10000)});
    visit(o.other_clock,
          Field{"other_clock", "",
                "a lidar that does not share the others' clock: align (shift its stamps by times of arrival, with a "
                "warning), quarantine (leave it out) or refuse (an error at the start; leave it out later)"});
  }
};

enum class OtherClock
{
  Align,
  Quarantine,
  Refuse,
};

/** Throws std::invalid_argument with the three names for any other text. */
OtherClock otherClockFromName(const std::string&);
}  // namespace scanloom
