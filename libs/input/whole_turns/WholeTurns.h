/**
 * Approach A of the paper (figure 1a), for comparison: each lidar is batched by spinning angle, as drivers do it, and
 * the turns of all lidars are put behind each other. What a scan spans, and which turns meet in it, depends on the
 * phase of the rotors; see doc/batching.md, "Against whole turns".
 */
#pragma once
#include "input/batching/Batcher.h"
#include "input/whole_turns/internal/TurnCollector.h"

#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
/** Which turns become one scan. */
enum class TurnGrouping
{
  /**
   * Each turn of lidar 0, and of every other lidar the turn whose middle is nearest, at most once each: what
   * approximate time synchronisation makes of the lidars' clouds. Waits for a turn under way if that one will be
   * nearer.
   */
  Nearest,

  /**
   * One turn of each, as they come; a lidar's second turn, or one that ends 0.21 s after the first of the scan, begins
   * the next scan: the rule of the Collator of Ouster SDK 1.0 for sensors without phase lock (frame_set_source_utils),
   * and, without that time limit, of MOLA's lidar odometry with several lidars. The order in which the lidars were
   * heard first settles for ever which turns meet.
   */
  OneOfEach,
};

/**
 * Takes what TimeBatcher takes and gives the same type of scan, with the differences of the approach: `start` is the
 * stamp of the oldest column and `period` reaches past the newest one, so scans vary in length and overlap; columns are
 * ordered by lidar, each lidar's in the order of arrival. Every point has its own time. `missing` names the lidars that
 * gave no turn or not a whole one. Blocks of turns that were put into no scan are counted as `dropped`.
 *
 * Host time is not used: a lidar that falls silent within a turn keeps that turn until its packets come again.
 */
class WholeTurns : public Batcher
{
 public:
  /** Throws std::invalid_argument without lidars, with more than 256 and for one without a decoder. */
  explicit WholeTurns(std::vector<BatchedLidar>, TurnGrouping = TurnGrouping::Nearest);

  std::vector<Scan> push(RoutedPacket) override;

  /** Nothing: time alone completes no turn. */
  std::vector<Scan> advance(Timestamp) override { return {}; }

  /** Also gives out turns that the end of input cut. */
  std::vector<Scan> finish() override;

  /**
   * Where packets come in order, no scan to come begins before this stamp; a lidar not heard yet, or silent for four
   * turns, is not waited for. None at the start.
   */
  std::optional<Timestamp> horizon() const override;

  Duration timeOffset(LidarIndex lidar) const override { return inputs_[lidar].time_offset; }

  /** None: host time is not used. */
  std::optional<Duration> ahead(LidarIndex, Timestamp, Timestamp) const override { return std::nullopt; }

  /** Never called: a turn has no slices. */
  void onSlice(SliceSink) override {}

  /** None: neither silence nor a clock changes what is done with turns. */
  std::vector<Notice> takeNotices() override { return {}; }

  /** The turn under way ends here. */
  void replace(LidarIndex, std::shared_ptr<const PacketDecoder>) override;

  const LidarCounters& counters(LidarIndex lidar) const override { return lidars_[lidar].counters; }
  const std::vector<BatchedLidar>& lidars() const override { return inputs_; }

 private:
  struct Lidar
  {
    std::unique_ptr<TurnCollector> turns;
    Duration period{0};  // nominal, of a turn
    LidarCounters counters;
    std::deque<Turn> waiting;                    // oldest first
    std::optional<Timestamp> newest_turn_began;  // given out or waiting
    Timestamp heard_until = Timestamp::min();
  };
  using ChosenTurns = std::vector<std::optional<Turn>>;  // by lidar

  void collect(LidarIndex);
  void add(LidarIndex, Turn, std::vector<Scan>&);
  void releaseNearest(std::vector<Scan>&);
  bool isChoiceCertain(const Lidar&, const Turn& reference) const;
  ChosenTurns chooseNearest();
  void addToSet(LidarIndex, Turn, std::vector<Scan>&);
  void releaseSet(std::vector<Scan>&);
  Scan concatenate(ChosenTurns);
  static void drop(Lidar&);

  std::vector<BatchedLidar> inputs_;
  TurnGrouping grouping_;
  std::vector<Lidar> lidars_;
  ChosenTurns set_;                     // OneOfEach: under collection
  std::optional<Timestamp> set_began_;  // OneOfEach: end of its first turn
  bool finished_ = false;
};
}  // namespace scanloom
