/**
 * Batching by sampling time at the driver: "A generic multi-lidar data batching strategy on the sensor driver level",
 * EuroCOW 2025, section 2.1. Where the paper waits for every lidar, watermarks with deadlines bound the wait.
 */
#pragma once
#include "batching/Batcher.h"
#include "batching/LidarInput.h"
#include "batching/Notice.h"
#include "batching/Scan.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
/**
 * Packets in, scans out, in one total order (stamp, sensor_id, measurement_id). The result depends on the packets and
 * their record times alone; where all lidars share a clock, any arrival order within the deadline gives the same bits.
 */
class TimeBatcher : public Batcher
{
 public:
  /** Throws std::invalid_argument without lidars, with more than 256, or for an unknown other_clock. */
  TimeBatcher(const std::vector<BatchedLidar>&, const BatcherOptions&);

  /**
   * Scans completed by this packet, oldest first. `received` is the host's (or the capture's record) time; it moves
   * the deadlines. IMU packets are not for here: see ImuOrder. With other_clock = refuse, throws std::runtime_error if
   * the lidars' clocks differ by more than max_clock_skew at the start.
   */
  std::vector<Scan> push(LidarIndex, Bytes packet, Timestamp received) override;

  /** Time has passed without a packet. */
  std::vector<Scan> advance(Timestamp now) override;

  /** No more packets: everything that waits comes out; the scan that is cut by the end is marked incomplete. */
  std::vector<Scan> finish() override;

  /** Called in push, advance and finish for each slice as soon as it is complete: see ScanSlice. */
  void onSlice(SliceSink sink) override { on_slice_ = std::move(sink); }

  /** The lidar is another one from here on, or is known at last; what waits is still read by the old decoder. */
  void replace(LidarIndex, std::shared_ptr<const PacketDecoder>) override;

  /** The memory of a scan that nobody needs any more, for those to come. */
  void recycle(Scan&&) override;

  /** Everything before this stamp has been given out. */
  std::optional<Timestamp> horizon() const override;

  /** What is added to this lidar's stamps at present, its IMU's included. */
  Duration timeOffset(LidarIndex lidar) const override { return inputs_[lidar].clock.offset(); }

  /** What a person should hear of, since the last call. */
  std::vector<Notice> takeNotices() override;

  /** At most queue_packets. */
  std::size_t waitingPackets(LidarIndex lidar) const { return inputs_[lidar].queue.packets(); }

  const LidarCounters& counters(LidarIndex lidar) const override { return inputs_[lidar].counters; }
  const LidarClock& clock(LidarIndex lidar) const { return inputs_[lidar].clock; }
  const std::vector<BatchedLidar>& lidars() const override { return lidars_; }

 private:
  void take(LidarIndex, Bytes packet, Timestamp received);
  void note(LidarIndex, Notice::Kind, Duration = Duration{0});
  void noteNews(LidarIndex, const std::vector<Notice::Kind>&);

  std::optional<LidarIndex> clockReference(LidarIndex) const;
  std::optional<Duration> commonDelay(LidarIndex) const;
  void settleClock(LidarIndex, const std::vector<Notice::Kind>& news);
  void watchClock(LidarIndex);

  std::optional<Timestamp> latestFirstStamp() const;
  std::vector<std::optional<Duration>> skewsAtStart() const;
  void startAfter(Timestamp latest_first_stamp);
  void settleClocksAtStart();

  std::vector<Scan> release();
  void raiseDeadlines();
  Timestamp watermark(const LidarInput&) const;
  void refreshFront(LidarIndex);
  void pass(Timestamp, std::vector<Scan>& closed);
  void skipSilence(Timestamp);
  void append(LidarIndex);
  void giveSlice();
  Timestamp sliceBegin() const;
  Timestamp sliceEnd() const;
  Scan closeScan();
  void markMissing(Scan&);
  Scan emptyScan(Timestamp start);

  std::vector<BatchedLidar> lidars_;
  BatcherOptions options_;
  OtherClock other_clock_;
  Duration period_, phase_, max_clock_skew_;
  std::vector<LidarInput> inputs_;
  std::vector<Timestamp> fronts_;  // oldest stamp that waits, per lidar; the end of time where none does

  Timestamp now_ = Timestamp::min();
  Timestamp first_start_ = Timestamp::min();  // t_init of eq. (1)
  Timestamp horizon_ = Timestamp::min();
  std::optional<Scan> scan_;    // under construction; none before the start
  std::optional<Column> last_;  // the newest column given out
  SensorMask silent_;           // those that a notice called so
  int slices_given_ = 0;        // of scan_
  std::size_t columns_given_ = 0;
  SliceSink on_slice_;
  std::vector<Scan> spare_;
  std::vector<Notice> notices_;
  bool finished_ = false;
};
}  // namespace scanloom
