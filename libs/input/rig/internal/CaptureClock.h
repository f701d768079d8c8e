#pragma once
#include "input/batching/RoutedPacket.h"

#include <optional>
#include <vector>

namespace scanloom
{
/**
 * Corrects a capture's receive times for steps of the capturing computer's clock, which a person or NTP may have set:
 * the batcher would take such a step for seconds of silence. A step is where receive times jump and the lidar's own
 * stamps go on. (Receive times of live input have no steps: SteadyStamps.)
 */
class CaptureClock
{
 public:
  explicit CaptureClock(std::size_t lidars) : last_(lidars) {}

  /** The packet's receive time as if the clock had never been set. */
  Timestamp steady(const RoutedPacket&);

  /** The sum of all steps so far, positive for a clock set forward; none if there was no step since the last call. */
  std::optional<Duration> takeStep();

 private:
  struct Times
  {
    Timestamp stamp, received;
  };

  std::vector<std::optional<Times>> last_;  // of each lidar's latest packet
  std::optional<Timestamp> newest_;         // receive time of the latest packet of any lidar
  Duration step_{0};                        // the sum of all steps
  bool has_stepped_ = false;                // since takeStep()
};
}  // namespace scanloom
