#pragma once
#include "base/core/Time.h"
#include "input/batching/PacketNumbering.h"

#include <cstdint>
#include <optional>

namespace scanloom
{
/** The ids and the stamp by which a packet is put in order. */
struct PacketPlace
{
  std::optional<std::uint32_t> init_id;
  std::uint32_t frame_id = 0;
  std::uint16_t measurement_id = 0;  // of its last valid block, or of any if none is valid
  std::optional<Timestamp> stamp;    // of that block, by the lidar's own clock; none if no block is valid
};

/**
 * Decides whether a packet continues its lidar's stream. Ids and stamps advance together: a turn later by the ids is a
 * turn's time later by the clock, even after a minute of silence. A packet that contradicts this is doubtful: it may be
 * damaged, another sender's, or the first one after a restart or a step of the lidar's clock. The next packet tells
 * which, and a stream that still goes on is not left.
 */
class Continuity
{
 public:
  enum class Verdict
  {
    Continues,
    Restarts,    // the ids start again, and perhaps the clock
    ClockSteps,  // the ids continue, the stamps have jumped by `step`
    Doubtful,    // agrees with no packet before it
  };
  struct Judgement
  {
    Verdict verdict = Verdict::Doubtful;
    std::int64_t block = 0;        // number of the packet's last block, see PacketNumbering; not for Doubtful
    std::int64_t first_block = 0;  // the same of the doubtful packet, the first of the new stream; for Restarts
    Duration step{0};              // new minus expected stamp; for ClockSteps
  };

  explicit Continuity(const LidarDescription&);

  Judgement judge(const PacketPlace&, Timestamp received);

  /**
   * How far ahead this stamp of the lidar's clock is of what the clock showed when it was received, judged by the
   * newest packet of the stream; none before the first one. What is off by more than kArrivalTolerance is not of this
   * clock.
   */
  std::optional<Duration> ahead(Timestamp stamp, Timestamp received) const;

  /** As measured; nominal at first. */
  Duration blockPeriod() const { return fromSeconds(block_period_); }

 private:
  struct Seen
  {
    std::optional<std::uint32_t> init_id;
    std::int64_t block = 0;
    std::optional<Timestamp> stamp;
    Timestamp received;
  };

  std::optional<std::int64_t> continued(const Seen&, const PacketPlace&, Timestamp received) const;
  std::optional<std::int64_t> byIds(const Seen&, const PacketPlace&, Timestamp received) const;
  std::optional<std::int64_t> byStamp(const Seen&, const PacketPlace&, Timestamp received) const;
  std::int64_t nearestBlock(const PacketPlace&, std::int64_t to) const;
  bool isOverdue(Timestamp received) const;
  Judgement breakConfirmedBy(const PacketPlace&, std::int64_t candidate_block, Timestamp received);
  void follow(const PacketPlace&, std::int64_t block, Timestamp received);
  Seen seen(const PacketPlace&, std::int64_t block, Timestamp received) const;
  double secondsOf(std::int64_t blocks) const { return static_cast<double>(blocks) * block_period_; }

  Numbering numbering_;
  std::int64_t blocks_per_turn_, blocks_per_packet_, blocks_of_all_frames_;
  double nominal_period_, block_period_;  // s
  std::optional<Seen> latest_;            // the newest packet that continues the stream
  std::optional<Seen> candidate_;         // the latest doubtful packet
};

/** Where stamps are checked against host time (no ids, or long silence, or an IMU): how late a packet may come. */
constexpr Duration kArrivalTolerance = 500ms;

/** Whether a stamp can be compared with host time at all. Sums of a few such differences fit 64 bits. */
bool isPlausible(Timestamp stamp, Timestamp received);

/** The same lidar; one without ids gets turns of a fixed number of packets, so that its packets can be numbered. */
LidarDescription numberedTurn(LidarDescription);
}  // namespace scanloom
