#pragma once
#include "batching/PacketNumbering.h"
#include "core/Time.h"

#include <cstdint>
#include <optional>

namespace scanloom
{
/** What a packet says of its place in its lidar's stream. */
struct PacketPlace
{
  std::optional<std::uint32_t> init_id;
  std::uint32_t frame_id = 0;
  std::uint16_t measurement_id = 0;  // of its last valid block, or of any if none is valid
  std::optional<Timestamp> stamp;    // of that block, by the lidar's own clock; none if no block is valid
};

/**
 * Whether a packet continues its lidar's stream. Ids and stamps advance together: a turn later by the ids is a turn's
 * time later by the clock, even after a minute of silence. A packet that breaks this is damaged, or the first one after
 * a restart or a step of the lidar's clock: which, the next packet tells. Until then it is doubtful.
 */
class Continuity
{
 public:
  enum class Verdict
  {
    Continues,
    Restarts,    // ids begin anew; so may the clock
    ClockSteps,  // ids go on, stamps have jumped by `step`
    Doubtful,    // agrees with nothing before it
  };
  struct Judgement
  {
    Verdict verdict = Verdict::Doubtful;
    std::int64_t block = 0;        // place of the packet's last block, see PacketNumbering; not for Doubtful
    std::int64_t first_block = 0;  // of the new stream, in the packet that was doubtful; for Restarts
    Duration step{0};              // new minus expected stamp; for ClockSteps
  };

  explicit Continuity(const LidarDescription&);

  Judgement judge(const PacketPlace&, Timestamp received);

  /** As measured; nominal at first. */
  Duration blockPeriod() const { return fromSeconds(block_period_); }

 private:
  struct Known
  {
    std::optional<std::uint32_t> init_id;
    std::int64_t block = 0;
    std::optional<Timestamp> stamp;
    Timestamp received;
  };

  std::optional<std::int64_t> continued(const Known&, const PacketPlace&, Timestamp received) const;
  std::optional<std::int64_t> byIds(const Known&, const PacketPlace&, Timestamp received) const;
  std::optional<std::int64_t> byStamp(const Known&, const PacketPlace&, Timestamp received) const;
  std::int64_t nearestBlock(const PacketPlace&, std::int64_t to) const;
  Judgement breakConfirmedBy(const PacketPlace&, std::int64_t candidate_block, Timestamp received);
  void follow(const PacketPlace&, std::int64_t block, Timestamp received);
  Known know(const PacketPlace&, std::int64_t block, Timestamp received) const;
  double secondsOf(std::int64_t blocks) const { return static_cast<double>(blocks) * block_period_; }

  Numbering numbering_;
  std::int64_t blocks_per_turn_, blocks_per_packet_, blocks_of_all_frames_;
  double nominal_period_, block_period_;  // s
  std::optional<Known> latest_;           // the newest packet that continued
  std::optional<Known> candidate_;        // the latest doubtful one
};

/** The blocks of a turn that its packets are numbered by; for a lidar without ids a number of packets that serves. */
LidarDescription numberedTurn(LidarDescription);
}  // namespace scanloom
