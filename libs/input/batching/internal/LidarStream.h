#pragma once
#include "input/batching/Continuity.h"
#include "input/batching/Counters.h"
#include "input/batching/RoutedPacket.h"
#include "input/batching/internal/Sequencer.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** What a packet brings, and what it shows of its lidar. */
struct SequencedPacket
{
  std::vector<MeasurementBlock> blocks;  // usable ones in time order, by the lidar's own clock; none if it came twice
  bool restarted = false;                // the lidar has started again
  std::optional<Duration> clock_step;    // its clock has jumped by this
  std::uint32_t flags = 0;               // as in Notice::flags
};

/** One lidar's packets, each put in its place in the order of sending. What is lost, repeated or damaged is counted. */
class LidarStream
{
 public:
  LidarStream(const LidarDescription&, Duration deadline);

  /** A lidar packet; none if it contradicts the packets before it. */
  std::optional<SequencedPacket> read(RoutedPacket, LidarCounters&);

  /** As Continuity::ahead. */
  std::optional<Duration> ahead(Timestamp stamp, Timestamp received) const
  {
    return continuity_.ahead(stamp, received);
  }

  /** Gaps that showed a deadline before `now`, or every gap, are given up: their blocks are counted as lost. */
  void giveUpGaps(Timestamp now, LidarCounters&);
  void giveUpAllGaps(LidarCounters&);

  /** No block with an earlier stamp is expected, by the lidar's own clock; none before the first packet. */
  std::optional<Timestamp> watermark() const { return sequencer_.watermark(); }

  /** The smallest stamp since the lidar started, by its own clock: t_0 of eq. (1). None before the first packet. */
  std::optional<Timestamp> firstStamp() const { return first_stamp_; }

 private:
  void markImplausible(std::vector<MeasurementBlock>&, Timestamp received) const;
  void unwrapStamps(std::vector<MeasurementBlock>&, Timestamp received);
  void noteBreak(const Continuity::Judgement&, SequencedPacket&, LidarCounters&);
  bool isNew(const Continuity::Judgement&, const PacketPlace&, Timestamp received, std::size_t usable_blocks,
             LidarCounters&);
  std::uint64_t blocksOf(std::uint64_t packets) const;

  LidarDescription lidar_;
  Continuity continuity_;
  Sequencer sequencer_;
  std::optional<Timestamp> first_stamp_;
  std::optional<Duration> delay_;  // arrival minus stamp of the newest packet, to unwrap the next one by
};
}  // namespace scanloom
