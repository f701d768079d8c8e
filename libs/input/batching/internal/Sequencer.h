#pragma once
#include "base/core/Time.h"
#include "input/batching/PacketNumbering.h"

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace scanloom
{
/**
 * Knows which of one lidar's packets are missing. Its watermark is a lower bound of all stamps still to come, by the
 * lidar's own clock, if no packet comes later than the deadline.
 */
class Sequencer
{
 public:
  enum class Verdict
  {
    New,
    Duplicate,
    Recovered,  // comes after it was given up and counted as lost
  };

  /** A packet by its last valid block, see PacketNumbering; without stamp if it has none. */
  struct Place
  {
    std::int64_t block = 0;
    std::optional<Timestamp> stamp;
    Duration block_period{0};
  };

  Sequencer(const LidarDescription&, Duration deadline);

  Verdict accept(const Place&, Timestamp received);

  /** A new stream begins with this block's packet. Returns the number of packets lost in open gaps before it. */
  std::uint64_t restart(std::int64_t block);

  /** The lidar's clock has jumped by this much. */
  void shift(Duration step);

  /** Gives up gaps that showed a deadline or more before `now`. Returns the number of packets lost in them. */
  std::uint64_t giveUpGaps(Timestamp now);

  /** No more packets will come: gives up every gap. Returns the number of packets lost in them. */
  std::uint64_t finish();

  /** Nothing with an earlier stamp is expected; none before the first packet. */
  std::optional<Timestamp> watermark() const { return watermark_; }

 private:
  struct Arrived
  {
    std::optional<Timestamp> earliest_next;  // packets after this one have no earlier stamp
    Timestamp received;
  };

  bool isRepeated(std::int64_t packet);
  std::optional<Timestamp> earliestAfter(const Place&) const;
  std::int64_t missingBefore(std::int64_t packet) const;
  void goOnAfter(std::int64_t packet, const Arrived&);
  std::uint64_t advance(Timestamp give_up_before);

  PacketNumbering numbering_;
  Duration deadline_;
  std::optional<std::int64_t> newest_;         // the last packet in unbroken order
  std::int64_t first_ = 0;                     // the first packet of this run
  std::map<std::int64_t, Arrived> after_gap_;  // packets that came before a missing one
  std::vector<std::int64_t> recent_;           // packets seen, each in its slot modulo the size
  std::optional<Timestamp> watermark_;
};
}  // namespace scanloom
