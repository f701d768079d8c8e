/**
 * Batching by sampling time at the driver: "A generic multi-lidar data batching strategy on the sensor driver level",
 * EuroCOW 2025, section 2.1. Where the paper waits for every lidar, watermarks with deadlines bound the wait.
 */
#pragma once
#include "batching/Counters.h"
#include "batching/PacketQueue.h"
#include "batching/Scan.h"
#include "batching/Sequencer.h"
#include "core/Field.h"

#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
using LidarIndex = std::size_t;

struct BatcherOptions
{
  double scan_rate = 10.0;
  double scan_phase_ms = 0.0;
  double deadline_ms = 5.0;
  double max_clock_skew = 1.0;
  int queue_packets = 1024;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.scan_rate,
          Field{"scan_rate", "Hz", "scans per second, whatever the lidars' own rates are", between(0.1, 1000)});
    visit(o.scan_phase_ms,
          Field{"scan_phase_ms", "ms", "scans start at multiples of the period plus this", between(0, 10000)});
    visit(o.deadline_ms,
          Field{"deadline_ms", "ms", "how much later than its fastest packets a lidar may deliver", between(0, 10000)});
    visit(o.max_clock_skew, Field{"max_clock_skew", "s", "lidars whose clocks differ by more are refused", above(0)});
    visit(o.queue_packets,
          Field{"queue_packets", "", "packets that wait per lidar at most; the oldest is dropped", atLeast(2)});
  }
};

/** A lidar as the batcher sees it. Its index in the list is the sensor_id of its points (at most 256 lidars). */
struct BatchedLidar
{
  std::string name;
  std::shared_ptr<const PacketDecoder> decoder;
  Duration time_offset{0};  // added to its stamps
};

/**
 * Packets in, scans out, in one total order (stamp, sensor_id, measurement_id). The result depends on the packets and
 * their record times alone: any arrival order within the deadline gives the same bits.
 */
class TimeBatcher
{
 public:
  /** Throws std::invalid_argument without lidars or with more than 256. */
  TimeBatcher(std::vector<BatchedLidar>, const BatcherOptions&);

  /**
   * Scans completed by this packet, oldest first. `received` is the host's (or the capture's record) time; it moves
   * the deadlines. IMU packets are not for here: see ImuOrder. Throws std::runtime_error if the lidars' clocks
   * differ by more than max_clock_skew at the start.
   */
  std::vector<Scan> push(LidarIndex, Bytes packet, Timestamp received);

  /** Time has passed without a packet. */
  std::vector<Scan> advance(Timestamp now);

  /** No more packets: everything that waits comes out; the scan that is cut by the end is marked incomplete. */
  std::vector<Scan> finish();

  /** Everything before this stamp has been given out. */
  std::optional<Timestamp> horizon() const;

  const LidarCounters& counters(LidarIndex lidar) const { return lidars_[lidar].counters; }
  const std::vector<BatchedLidar>& lidars() const { return inputs_; }

 private:
  struct Lidar
  {
    PacketQueue queue;
    Sequencer sequencer;
    LidarCounters counters;
    std::optional<Timestamp> first_stamp;    // t_0 of eq. (1), the smallest before the start
    std::optional<Duration> least_delay;     // arrival minus the packet's last stamp
    std::optional<Timestamp> sequence_mark;  // the sequencer's watermark on the common clock
    Timestamp deadline_mark = Timestamp::min();
  };

  bool take(LidarIndex, Bytes packet, Timestamp received);
  std::vector<MeasurementBlock> usableBlocks(LidarIndex, Timestamp received);
  void raiseDeadlines();
  Timestamp watermark(const Lidar&) const;
  std::optional<Timestamp> latestFirstStamp() const;
  void startAfter(Timestamp latest_first_stamp);
  std::vector<Scan> release();
  std::optional<LidarIndex> oldest() const;
  void appendOldest(LidarIndex);
  Scan closeScan();
  Scan emptyScan(Timestamp start) const;
  void refuseDifferentClocks() const;

  std::vector<BatchedLidar> inputs_;
  BatcherOptions options_;
  Duration period_, phase_, deadline_;
  std::vector<Lidar> lidars_;
  std::vector<MeasurementBlock> blocks_;  // of the packet in hand; kept for its memory

  Timestamp now_ = Timestamp::min();
  Timestamp first_start_ = Timestamp::min();  // t_init of eq. (1)
  std::optional<Scan> scan_;                  // under construction; none before the start
  std::optional<Column> last_;                // the newest column given out
  bool finished_ = false;
};
}  // namespace scanloom
