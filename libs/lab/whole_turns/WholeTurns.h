/**
 * Approach A of the paper (figure 1a), for comparison: one whole turn of each lidar is a scan. What it spans, and which
 * turns meet in it, depends on the phase of the rotors; see doc/batching.md, "Against whole turns".
 */
#pragma once
#include "input/batching/Scan.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** Which turns become one scan. */
enum class TurnGrouping
{
  /** Each turn of lidar 0, and of every other lidar the turn whose middle is nearest, at most once each: what
   * approximate time synchronisation makes of the lidars' clouds. */
  Nearest,

  /**
   * One turn of each, as they end; a lidar's second turn, or one that ends 0.21 s after the first of the scan, begins
   * the next scan: the rule of the Collator of Ouster SDK 1.0 for sensors without phase lock (frame_set_source_utils),
   * and, without that time limit, of MOLA's lidar odometry with several lidars. The order in which the lidars began
   * settles for ever which turns meet.
   */
  OneOfEach,
};

/** Of "nearest" or "one_of_each". Throws std::invalid_argument for any other name, with the values of
 * [simulated_recording] whole_turns. */
TurnGrouping turnGroupingFromName(const std::string&);

/** Columns of one lidar from its encoder's zero to the next, in time order; never empty. */
struct Turn
{
  std::vector<Column> columns;
  PointCloud points;  // t is ns after the first column

  Timestamp first() const { return columns.front().stamp; }
  Timestamp last() const { return columns.back().stamp; }
  Timestamp middle() const { return first() + (last() - first()) / 2; }
};

/**
 * Scans by time in, scans of whole turns out. Each column is in one of either, so both see the same packets. Scans of
 * turns vary in length and overlap: they begin with their oldest column and end with their last point. `missing` names
 * the lidars without a turn in the scan. A lidar's first turn is left out if its beginning is missing: drivers do not
 * give it either. Columns that are lost later are missing in their turn; the last turn is what there is of it.
 */
class WholeTurns
{
 public:
  WholeTurns(std::size_t lidars, TurnGrouping);

  /** Scans that are complete, oldest first. */
  std::vector<Scan> push(const Scan& by_time);

  /** Also takes the turns under way. */
  std::vector<Scan> finish();

 private:
  using ChosenTurns = std::vector<std::optional<Turn>>;  // by lidar

  void endTurn(std::size_t lidar);
  void releaseNearest();
  ChosenTurns chooseNearest();
  void addToSet(std::size_t lidar, Turn);
  void releaseSet();

  TurnGrouping grouping_;
  std::vector<std::optional<Turn>> under_way_;  // by lidar
  std::vector<bool> has_begun_;                 // by lidar: a turn of it was whole at its beginning
  std::vector<std::deque<Turn>> waiting_;       // by lidar, oldest first: Nearest
  ChosenTurns set_;                             // under collection: OneOfEach
  std::vector<Scan> released_;
  bool finished_ = false;
};
}  // namespace scanloom
