#pragma once
#include "core/Time.h"
#include "lidar/PacketDecoder.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace scanloom
{
/** The packets of a turn, numbered without end: the place of a packet among all that the lidar sends. */
class PacketNumbering
{
 public:
  explicit PacketNumbering(const LidarDescription&);

  int packetsPerTurn() const { return static_cast<int>(sent_before_.size()) - 1; }

  /** How many packets within the azimuth window have a number below this one. */
  std::int64_t sentBefore(std::int64_t number) const;

  /** Blocks from this column to the next one within the azimuth window: 1 inside it. */
  int blocksToNext(int column) const { return blocks_to_next_[static_cast<std::size_t>(column)]; }

 private:
  std::vector<int> sent_before_;     // per packet of a turn, with the total at the end
  std::vector<int> blocks_to_next_;  // per column of a turn
};

/**
 * Puts one lidar's packets in order by (frame id, measurement id) and knows what is missing. Its watermark is a lower
 * bound of every stamp that the lidar can still deliver, as long as nothing comes later than the deadline.
 */
class Sequencer
{
 public:
  enum class Verdict
  {
    New,
    Duplicate,
    Recovered,  // had been given up and counted as lost
    Restarted,  // new, and nothing before it counts any more
  };

  Sequencer(const LidarDescription&, Duration deadline);

  /** A packet by its last valid block (the stamp counts) or, if it has none, by any (then its stamp is
   * Timestamp::min()). */
  Verdict accept(const PacketHeader&, const MeasurementBlock& last, Timestamp received);

  /** Gaps shown before `now` - deadline are given up. Returns the packets that are thereby lost. */
  std::uint64_t giveUpGaps(Timestamp now);

  /** Every gap is given up: no more input. */
  std::uint64_t finish();

  /** Nothing with an earlier stamp is expected; none before the first packet. */
  std::optional<Timestamp> watermark() const { return watermark_; }

 private:
  struct Arrived
  {
    Timestamp earliest_next;  // no stamp before this can follow
    Timestamp received;
  };

  void restart(std::int64_t number, std::uint32_t frame_id);
  std::int64_t unwrap(std::uint32_t frame_id) const;
  Timestamp earliestAfter(const MeasurementBlock& last) const;
  std::uint64_t advance(std::optional<Timestamp> give_up_shown_until);

  PacketNumbering numbering_;
  Duration block_period_;
  Duration deadline_;
  std::uint64_t frame_id_modulus_;
  int columns_per_packet_;

  std::optional<std::uint32_t> init_id_;
  std::optional<std::int64_t> newest_;         // number of the last packet in unbroken order
  std::int64_t first_ = 0;                     // number of the first packet of this run
  std::int64_t newest_frame_ = 0;              // unwrapped
  std::map<std::int64_t, Arrived> after_gap_;  // arrived ahead of something that is missing
  std::set<std::int64_t> recent_;              // numbers seen, for duplicates
  std::optional<Timestamp> watermark_;
};
}  // namespace scanloom
