/**
 * Batching by sampling time at the driver: "A generic multi-lidar data batching strategy on the sensor driver level",
 * EuroCOW 2025, section 2.1. Where the paper waits for every lidar, watermarks with deadlines bound the wait.
 */
#pragma once
#include "input/batching/Counters.h"
#include "input/batching/RoutedPacket.h"
#include "input/batching/Scan.h"
#include "input/batching/internal/BatcherOptions.h"
#include "input/batching/internal/LidarClocks.h"
#include "input/batching/internal/LidarNotices.h"
#include "input/batching/internal/LidarStream.h"
#include "input/batching/internal/PacketQueue.h"
#include "input/batching/internal/ScanUnderConstruction.h"
#include "input/batching/internal/StreamPresence.h"

#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
/**
 * Packets in, scans out, in one total order (stamp, sensor_id, measurement_id). The result depends on the packets and
 * their record times alone; where all lidars share a clock, any arrival order within the deadline gives the same bits.
 */
class TimeBatcher
{
 public:
  /** Throws std::invalid_argument without lidars, with more than 256, or for an unknown other_clock. */
  TimeBatcher(const std::vector<BatchedLidar>&, const BatcherOptions&);

  /**
   * Scans completed by this packet, oldest first. IMU packets are not for here: see ImuOrder. The packet's time of
   * reception moves the deadlines. With other_clock = refuse, throws std::runtime_error if the lidars' clocks differ by
   * more than max_clock_skew at the start.
   */
  std::vector<Scan> push(RoutedPacket);

  /** Scans completed because time has passed without a packet. */
  std::vector<Scan> advance(Timestamp now);

  /** No more packets will come: all that waits is given out. The scan that is cut by the end is marked incomplete. */
  std::vector<Scan> finish();

  /** Called in push, advance and finish for each slice as soon as it is complete: see ScanSlice. */
  void onSlice(SliceSink sink) { on_slice_ = std::move(sink); }

  /** The lidar's packets have another format from here on, or a known one at last. Waiting ones keep their decoder. */
  void replace(LidarIndex, std::shared_ptr<const PacketDecoder>);

  /** Every column with an earlier stamp has been given out; none before the first scan starts. */
  std::optional<Timestamp> horizon() const { return scan_ ? std::optional(horizon_) : std::nullopt; }

  /** What is added to this lidar's stamps at present, also to those of its IMU. */
  Duration timeOffset(LidarIndex lidar) const { return clocks_[lidar].offset(); }

  /**
   * How far ahead a stamp of this lidar's own clock, say of its IMU, is of what the clock showed when it was received.
   * None while nothing was received from the lidar.
   */
  std::optional<Duration> ahead(LidarIndex, Timestamp stamp, Timestamp received) const;

  /** What a person should know, since the last call. */
  std::vector<Notice> takeNotices() { return notices_.take(); }

  const LidarCounters& counters(LidarIndex lidar) const { return inputs_[lidar].counters; }

  /** With the decoders in use. */
  const std::vector<BatchedLidar>& lidars() const { return lidars_; }

 private:
  /** A lidar's packets on their way into scans. */
  struct Input
  {
    std::optional<LidarStream> stream;       // none while the lidar is not known
    std::optional<StreamPresence> presence;  // as stream
    PacketQueue queue;
    LidarCounters counters;
    Duration patience;                           // how much later than the quickest packets a block may come
    Timestamp deadline_mark = Timestamp::min();  // no earlier stamp is waited for, whatever may come
  };

  Duration deadline() const { return fromSeconds(1e-3 * options_.deadline_ms); }
  void follow(LidarIndex);
  void beginAnew(LidarIndex);
  void enqueue(RoutedPacket);
  void noteBreak(LidarIndex, const SequencedPacket&);
  void settleClock(LidarIndex, const SequencedPacket&);
  void refreshFront(LidarIndex);

  std::vector<Scan> merge();
  void startScans();
  Timestamp firstStart(Timestamp latest_first_stamp) const;
  std::optional<std::vector<bool>> lidarsWithClock();
  void settleClocksAtStart(const std::vector<bool>& accepted);
  void raiseHorizon();
  Timestamp watermark(LidarIndex) const;
  Timestamp sequenceMark(LidarIndex) const;
  void closeUntil(Timestamp, std::vector<Scan>& closed);
  SensorMask missingLidars();
  void takeOldestBlock(LidarIndex);

  std::vector<BatchedLidar> lidars_;
  BatcherOptions options_;
  Duration period_;
  std::vector<Input> inputs_;      // of each lidar
  std::vector<Timestamp> fronts_;  // of each lidar: the oldest stamp that waits; the end of time where none does
  LidarClocks clocks_;
  LidarNotices notices_;
  SliceSink on_slice_;

  Timestamp now_ = Timestamp::min();
  Timestamp horizon_ = Timestamp::min();
  std::optional<ScanUnderConstruction> scan_;  // none before the first one starts
  bool finished_ = false;
};
}  // namespace scanloom
