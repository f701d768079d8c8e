#pragma once
#include "batching/BatcherOptions.h"
#include "batching/Continuity.h"
#include "batching/Counters.h"
#include "batching/LidarClock.h"
#include "batching/Notice.h"
#include "batching/PacketQueue.h"
#include "batching/Sequencer.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** One lidar's way from packets to blocks that wait in the order of the common clock, every fate counted. */
class LidarInput
{
 public:
  LidarInput(const BatchedLidar&, const BatcherOptions&);

  /**
   * Sorts a packet into its stream. True if it holds blocks for scans: once the clock is settled, call enqueue() with
   * the same packet, or quarantine(). What happened to the stream is added to `news`.
   */
  bool read(Bytes packet, Timestamp received, std::vector<Notice::Kind>& news);
  void enqueue(Bytes packet);

  void quarantine();

  void replace(std::shared_ptr<const PacketDecoder>);

  /** Gaps that were shown a deadline ago are given up. */
  void giveUpGaps(Timestamp now);
  void giveUpAll();

  /**
   * Nothing with an earlier stamp comes any more: by what was received, and by host time. Both on the common clock; the
   * former is nothing before the first packet, the latter supposes `delay` for the fastest packets.
   */
  std::optional<Timestamp> sequenceMark() const;
  void raiseDeadline(Timestamp now, Duration delay);
  Timestamp deadlineMark() const { return deadline_mark_; }
  Timestamp deadlineAt(Timestamp now, Duration delay) const;

  /** The smallest stamp before the first scan: t_0 of eq. (1), on the common clock; none if it was not heard. */
  std::optional<Timestamp> firstStamp() const;

  /** How far the clock stepped with the packet in hand. */
  Duration step() const { return step_; }
  std::uint32_t flags() const { return flags_; }
  /** How long nothing had come before the packet in hand. */
  Duration silence() const { return silence_; }

  PacketQueue queue;
  LidarClock clock;
  LidarCounters counters;

 private:
  bool isLidarPacket(Bytes packet);
  void noteFlags(const PacketHeader&, std::vector<Notice::Kind>& news);
  void readBlocks(Bytes packet, Timestamp received);
  PacketPlace placeOf(const PacketHeader&) const;
  void breakStream(const Continuity::Judgement&, std::vector<Notice::Kind>& news);
  bool countedOnce(std::int64_t last_block, const PacketPlace&, Timestamp received);
  void unwrapStamps(Timestamp received);
  void hear(Timestamp received);

  std::vector<std::shared_ptr<const PacketDecoder>> decoders_;  // all so far: what waits is read by those before
  const PacketDecoder* decoder_ = nullptr;                      // the newest
  Duration deadline_;
  std::size_t blocks_per_packet_ = 0;
  Duration packet_time_{0};
  std::optional<Continuity> continuity_;  // with the decoder
  std::optional<Sequencer> sequencer_;
  std::vector<MeasurementBlock> blocks_;       // the usable ones of the packet in hand, by the lidar's own clock
  MeasurementBlock any_block_;                 // of the packet in hand, for its ids where none is usable
  std::size_t invalid_ = 0, implausible_ = 0;  // the others of the packet in hand
  std::optional<Timestamp> first_stamp_;       // by the lidar's own clock
  std::optional<Duration> delay_;              // arrival minus stamp of the newest packet, to unwrap the next by
  Timestamp deadline_mark_ = Timestamp::min();
  Duration step_{0};
  std::uint32_t flags_ = 0;
  std::optional<Timestamp> heard_;
  Duration silence_{0};
};
}  // namespace scanloom
