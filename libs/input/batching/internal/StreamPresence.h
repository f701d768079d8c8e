#pragma once
#include "input/lidar/PacketDecoder.h"

#include <optional>

namespace scanloom
{
/**
 * How long and how densely a lidar has been sending. A few packets, damaged or another sender's, must not say what time
 * it is: the first scan waits until a lidar's stream has lasted.
 */
class StreamPresence
{
 public:
  /** @param scan_period at rates above 40 Hz a shorter while must do, or the first scans would come late. */
  StreamPresence(const LidarDescription&, Duration scan_period);

  /** A packet with blocks for scans, by its newest stamp. False if it contradicts the stream so far, which is
   * forgotten.
   */
  bool note(Timestamp stamp, Timestamp received);

  /** What came before counts no more. */
  void restart() { stream_.reset(); }

  /** Whether packets came for a while, not much thinner than this lidar sends them. False if none came. */
  bool isEstablished() const;

  /** Whether it may soon last. */
  bool isStarting(Timestamp now) const;

  /** Whether no packet has come for longer than a lidar pauses within its turn. False if none came at all. */
  bool isLost(Timestamp now) const;

 private:
  struct Stream
  {
    Timestamp first, latest;
    Duration delay{0};  // of the latest packet: arrival minus stamp
    std::int64_t packets = 0;
  };

  Duration while_;
  Duration packet_every_;  // on average over a turn
  std::optional<Stream> stream_;
};
}  // namespace scanloom
