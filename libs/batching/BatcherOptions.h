#pragma once
#include "core/Field.h"
#include "core/Time.h"
#include "lidar/PacketDecoder.h"

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
  std::string batching = "time";
  double scan_rate = 10.0;
  double scan_phase_ms = 0.0;
  int slices = 1;
  double deadline_ms = 5.0;
  double max_clock_skew = 0.1;
  std::string other_clock = "align";
  int queue_packets = 1024;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.batching, Field{"batching", "",
                            "by time, or whole turns of each lidar behind each other for comparison: nearest_turns or "
                            "one_turn_of_each, which know none of the keys below"});
    visit(o.scan_rate,
          Field{"scan_rate", "Hz", "scans per second, whatever the lidars' own rates are", between(0.1, 1000)});
    visit(o.scan_phase_ms,
          Field{"scan_phase_ms", "ms", "scans start at multiples of the period plus this", between(0, 10000)});
    visit(o.slices, Field{"slices", "", "parts of a scan that are given out as they are complete", between(1, 1000)});
    visit(o.deadline_ms,
          Field{"deadline_ms", "ms", "how much later than its fastest packets a lidar may deliver", between(0, 10000)});
    visit(o.max_clock_skew,
          Field{"max_clock_skew", "s", "lidars whose packets arrive so much apart by their stamps share no clock",
                above(0)});
    visit(o.other_clock,
          Field{"other_clock", "",
                "a lidar of another clock is: align (by times of arrival, with a warning), quarantine (left out) or "
                "refuse (an error at the start, left out later)"});
    visit(o.queue_packets,
          Field{"queue_packets", "", "packets that wait per lidar at most; the oldest is dropped", atLeast(2)});
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
