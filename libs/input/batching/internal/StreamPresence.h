#pragma once
#include "input/lidar/PacketDecoder.h"

#include <optional>

namespace scanloom
{
/**
 * How long and how densely a lidar has been heard. A few packets, damaged or another sender's, must not say what time
 * it is: the first scan waits until what is heard of a lidar has lasted.
 */
class StreamPresence
{
 public:
  /** @param scan_period at rates above 40 Hz a shorter while must do, or the first scans would come late. */
  StreamPresence(const LidarDescription&, Duration scan_period);

  /** A packet with blocks for scans, by its newest stamp. False if it contradicts what was heard, which is forgotten.
   */
  bool note(Timestamp stamp, Timestamp received);

  /** What was heard before counts no more. */
  void restart() { heard_.reset(); }

  /** Whether packets came for a while, not much thinner than this lidar sends them. False if none came. */
  bool isEstablished() const;

  /** Whether it may soon last. */
  bool isStarting(Timestamp now) const;

  /** Whether no packet has come for longer than a lidar pauses within its turn. False if none came at all. */
  bool isLost(Timestamp now) const;

 private:
  struct Heard
  {
    Timestamp first, latest;
    Duration delay{0};  // of the latest packet: arrival minus stamp
    std::int64_t packets = 0;
  };

  Duration while_;
  Duration packet_every_;  // on average over a turn
  std::optional<Heard> heard_;
};
}  // namespace scanloom
