#include "lab/whole_turns/WholeTurns.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
// dt_ns of the Collator of Ouster SDK 1.0 unless its user says otherwise.
constexpr Duration kLongestSet = 210ms;

// Turns whose middles are further apart, in turns, do not belong together: half a turn and some jitter.
constexpr double kNearestAtMost = 0.55;

// A lidar without a turn in so many turns of lidar 0 is silent and not waited for.
constexpr std::size_t kTurnsThatWait = 4;

Duration distance(const Turn& a, const Turn& b) { return std::chrono::abs(a.middle() - b.middle()); }

bool beginsTurn(const Column& column, const Column& before)
{
  return column.frame_id != before.frame_id || column.measurement_id < before.measurement_id;
}

/** Appends the column's points, whose times count from `start`. */
void append(const PointCloud& from, const Column& column, Timestamp from_start, PointCloud& to, Timestamp to_start)
{
  const auto later = static_cast<std::int32_t>((from_start - to_start).count());
  for (std::size_t i = column.first_point; i < column.first_point + column.count; ++i)
  {
    to.append(from, i);
    to.t[to.size() - 1] += later;
  }
}

void append(const Scan& scan, const Column& column, Turn& turn)
{
  turn.columns.push_back(column);
  turn.columns.back().first_point = static_cast<std::uint32_t>(turn.points.size());
  append(scan.points, column, scan.start, turn.points, turn.first());
}

/** The turns' columns in time order, as scans have them. */
Scan scanOf(const std::vector<std::optional<Turn>>& turns)
{
  Scan scan;
  scan.start = Timestamp::max();
  std::vector<std::pair<Column, const Turn*>> columns;
  for (std::size_t i = 0; i < turns.size(); ++i)
  {
    scan.missing.set(i, !turns[i]);
    scan.columns_of.push_back(turns[i] ? static_cast<std::uint32_t>(turns[i]->columns.size()) : 0);
    if (!turns[i]) continue;
    scan.start = std::min(scan.start, turns[i]->first());
    for (const Column& column : turns[i]->columns) columns.emplace_back(column, &*turns[i]);
  }
  std::stable_sort(columns.begin(), columns.end(),
                   [](const auto& a, const auto& b) { return a.first.stamp < b.first.stamp; });
  for (auto& [column, turn] : columns)
  {
    const auto first_point = static_cast<std::uint32_t>(scan.points.size());
    append(turn->points, column, turn->first(), scan.points, scan.start);
    column.first_point = first_point;
    scan.columns.push_back(column);
  }
  scan.period = scan.columns.back().stamp - scan.start + 1ns;
  for (const std::int32_t t : scan.points.t) scan.period = std::max<Duration>(scan.period, Duration{t} + 1ns);
  return scan;
}
}  // namespace

TurnGrouping turnGroupingFromName(const std::string& name)
{
  if (name == "nearest") return TurnGrouping::Nearest;
  if (name == "one_of_each") return TurnGrouping::OneOfEach;
  throw std::invalid_argument(fmt::format("{}: must be nearest, one_of_each or none", name));
}

WholeTurns::WholeTurns(std::size_t lidars, TurnGrouping grouping)
  : grouping_(grouping), under_way_(lidars), has_begun_(lidars), waiting_(lidars), set_(lidars)
{
}

std::vector<Scan> WholeTurns::push(const Scan& by_time)
{
  for (const Column& column : by_time.columns)
  {
    std::optional<Turn>& turn = under_way_.at(column.sensor_id);
    if (turn && beginsTurn(column, turn->columns.back()))
    {
      const bool cut = turn->columns.front().measurement_id > column.measurement_id;
      if (!cut || has_begun_[column.sensor_id]) endTurn(column.sensor_id);
      turn.reset();
      has_begun_[column.sensor_id] = true;
    }
    append(by_time, column, turn ? *turn : turn.emplace());
  }
  return std::exchange(released_, {});
}

std::vector<Scan> WholeTurns::finish()
{
  finished_ = true;
  for (std::size_t lidar = 0; lidar < under_way_.size(); ++lidar)
    if (under_way_[lidar]) endTurn(lidar);
  releaseNearest();
  releaseSet();
  return std::exchange(released_, {});
}

void WholeTurns::endTurn(std::size_t lidar)
{
  Turn turn = *std::exchange(under_way_[lidar], std::nullopt);
  if (grouping_ == TurnGrouping::OneOfEach) return addToSet(lidar, std::move(turn));
  waiting_[lidar].push_back(std::move(turn));
  if (!finished_) releaseNearest();
}

void WholeTurns::releaseNearest()
{
  const std::deque<Turn>& references = waiting_.front();
  // A turn after the reference's middle shows that no nearer one is to come.
  const auto certain = [&](const std::deque<Turn>& turns)
  {
    return finished_ || references.size() > kTurnsThatWait ||
           (!turns.empty() && turns.back().middle() >= references.front().middle());
  };
  while (!references.empty() && std::all_of(waiting_.begin(), waiting_.end(), certain))
    released_.push_back(scanOf(chooseNearest()));
}

/** The oldest turn of lidar 0 and, of every other lidar, the nearest one; older ones are dropped. */
WholeTurns::ChosenTurns WholeTurns::chooseNearest()
{
  const auto takeFrom = [](std::deque<Turn>& turns)
  {
    Turn turn = std::move(turns.front());
    turns.pop_front();
    return turn;
  };
  ChosenTurns chosen(waiting_.size());
  chosen[0] = takeFrom(waiting_[0]);
  const Turn& reference = *chosen[0];
  for (std::size_t i = 1; i < waiting_.size(); ++i)
  {
    std::deque<Turn>& turns = waiting_[i];
    while (turns.size() > 1 && distance(turns[1], reference) <= distance(turns[0], reference)) turns.pop_front();
    if (turns.empty()) continue;
    const Duration longest = std::max(turns[0].last() - turns[0].first(), reference.last() - reference.first());
    if (seconds(distance(turns[0], reference)) <= kNearestAtMost * seconds(longest)) chosen[i] = takeFrom(turns);
  }
  return chosen;
}

void WholeTurns::addToSet(std::size_t lidar, Turn turn)
{
  const bool late = std::any_of(set_.begin(), set_.end(),
                                [&](const auto& other) { return other && turn.last() >= other->last() + kLongestSet; });
  if (set_[lidar] || late) releaseSet();
  set_[lidar] = std::move(turn);
  if (std::all_of(set_.begin(), set_.end(), [](const auto& other) { return other.has_value(); })) releaseSet();
}

void WholeTurns::releaseSet()
{
  if (std::any_of(set_.begin(), set_.end(), [](const auto& turn) { return turn.has_value(); }))
    released_.push_back(scanOf(std::exchange(set_, ChosenTurns(set_.size()))));
}
}  // namespace scanloom
