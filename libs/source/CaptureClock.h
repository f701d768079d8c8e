#pragma once
#include "batching/Batcher.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace scanloom
{
/**
 * Makes a capture's stamps of reception steady. Somebody, or NTP, may have set the clock of the computer that captured;
 * for the batcher's deadlines that would be seconds of silence. A step shows where the stamps of reception jump and the
 * lidar's own stamps run on. (What is received live is steady already: SteadyStamps.)
 */
class CaptureClock
{
 public:
  explicit CaptureClock(std::size_t lidars) : last_(lidars) {}

  /** A lidar's packet, the stamp of its first valid block by the lidar's own clock, its stamp of reception. */
  void observe(LidarIndex, Timestamp stamp, Timestamp received);

  /** A stamp of reception as if the clock had never been set. */
  Timestamp steady(Timestamp received) const { return received - step_; }

  /** All steps together; later is positive. */
  Duration step() const { return step_; }
  std::uint64_t steps() const { return steps_; }

 private:
  struct Packet
  {
    Timestamp stamp, received;
  };

  std::vector<std::optional<Packet>> last_;  // of each lidar
  std::optional<Timestamp> newest_;          // of any lidar
  Duration step_{0};
  std::uint64_t steps_ = 0;
};
}  // namespace scanloom
