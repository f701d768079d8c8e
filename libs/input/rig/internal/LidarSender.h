#pragma once
#include "input/lidar/PacketDecoder.h"
#include "input/packets/IpAddress.h"

#include <optional>

namespace scanloom
{
/**
 * From which address a lidar's packets come: the first sender is kept for as long as it sends as a lidar does. Another
 * one, which may copy the serial number, is refused. It takes over where the first has fallen silent, or had never sent
 * more than a few packets and now sends fewer than the other.
 */
class LidarSender
{
 public:
  explicit LidarSender(const LidarDescription&);

  enum class Verdict
  {
    Kept,       // the known sender, or the first one
    TakesOver,  // another one, from here on the known sender
    Refused,
  };

  /** Of a lidar packet. */
  Verdict judge(const IpAddress& source, Timestamp received);

  /** None before the first packet. */
  std::optional<IpAddress> address() const { return sender_ ? std::optional(sender_->source) : std::nullopt; }

 private:
  /** Packets of one sender in the window of time under way and in the one before. */
  struct Tally
  {
    IpAddress source;
    std::int64_t window = 0;
    std::int64_t before = 0, now = 0;
  };

  static void count(Tally&, std::int64_t window);
  static std::int64_t recent(const Tally&, std::int64_t window);

  Duration window_;
  std::int64_t of_a_lidar_;  // fewest packets of a lidar in a window
  std::optional<Tally> sender_, rival_;
};
}  // namespace scanloom
