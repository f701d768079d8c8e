#include "input/whole_turns/WholeTurns.h"

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

// Turns whose middles are further apart, in periods, do not belong together: half a period and some jitter.
constexpr double kNearestAtMost = 0.55;

// Most turns per lidar that wait for turns of the others.
constexpr std::size_t kTurnsThatWait = 4;

Duration distance(const Turn& a, const Turn& b) { return std::chrono::abs(a.middle() - b.middle()); }
}  // namespace

WholeTurns::WholeTurns(std::vector<BatchedLidar> lidars, TurnGrouping grouping)
  : inputs_(std::move(lidars)), grouping_(grouping), set_(inputs_.size())
{
  if (inputs_.empty() || inputs_.size() > kMostLidars)
    throw std::invalid_argument(fmt::format("{} lidars: 1 to {} can be batched", inputs_.size(), kMostLidars));
  for (LidarIndex i = 0; i < inputs_.size(); ++i)
  {
    if (!inputs_[i].decoder)
      throw std::invalid_argument(
          fmt::format("lidar '{}' is not known yet: whole turns need its metadata at the start", inputs_[i].name));
    lidars_.emplace_back();
    collect(i);
  }
}

void WholeTurns::collect(LidarIndex lidar)
{
  const LidarDescription& description = inputs_[lidar].decoder->description();
  const auto make = description.numbering == Numbering::Ids ? makeFrameIdTurns : makeAzimuthTurns;
  lidars_[lidar].turns = make(inputs_[lidar].decoder, inputs_[lidar].time_offset, static_cast<std::uint8_t>(lidar));
  lidars_[lidar].period = fromSeconds(1 / description.frame_rate);
}

void WholeTurns::replace(LidarIndex lidar, std::shared_ptr<const PacketDecoder> decoder)
{
  for (Turn& turn : lidars_[lidar].turns->finish(lidars_[lidar].counters))
    lidars_[lidar].waiting.push_back(std::move(turn));
  inputs_[lidar].decoder = std::move(decoder);
  collect(lidar);
}

std::vector<Scan> WholeTurns::push(RoutedPacket packet)
{
  Lidar& lidar = lidars_[packet.lidar];
  LidarCounters& count = lidar.counters;
  std::vector<Scan> scans;
  if (!countUnlessLidar(packet.kind, count) || packet.blocks.empty()) return scans;
  ++count.packets;
  count.received += packet.blocks.size();
  for (const MeasurementBlock& block : packet.blocks) count.invalid += !block.valid;
  for (Turn& turn : lidar.turns->push(packet, count)) add(packet.lidar, std::move(turn), scans);
  return scans;
}

std::vector<Scan> WholeTurns::finish()
{
  finished_ = true;
  std::vector<Scan> scans;
  for (LidarIndex i = 0; i < lidars_.size(); ++i)
    for (Turn& turn : lidars_[i].turns->finish(lidars_[i].counters)) add(i, std::move(turn), scans);
  if (grouping_ == TurnGrouping::Nearest)
    releaseNearest(scans);
  else
    releaseSet(scans);
  for (Lidar& lidar : lidars_)
    while (!lidar.waiting.empty()) drop(lidar);
  return scans;
}

void WholeTurns::add(LidarIndex index, Turn turn, std::vector<Scan>& scans)
{
  Lidar& lidar = lidars_[index];
  lidar.newest_turn_began = turn.first;
  lidar.heard_until = std::max(lidar.heard_until, turn.last);
  if (grouping_ == TurnGrouping::OneOfEach)
  {
    addToSet(index, std::move(turn), scans);
    return;
  }
  if (lidar.waiting.size() >= kTurnsThatWait) drop(lidar);
  lidar.waiting.push_back(std::move(turn));
  releaseNearest(scans);
}

void WholeTurns::releaseNearest(std::vector<Scan>& scans)
{
  std::deque<Turn>& references = lidars_.front().waiting;
  const auto certain = [&](const Lidar& lidar)
  { return finished_ || references.size() > 1 || isChoiceCertain(lidar, references.front()); };
  while (!references.empty() && std::all_of(lidars_.begin() + 1, lidars_.end(), certain))
    scans.push_back(concatenate(chooseNearest()));
}

/** Whether no turn to come can be nearer to the reference than those that wait. */
bool WholeTurns::isChoiceCertain(const Lidar& lidar, const Turn& reference) const
{
  if (!lidar.newest_turn_began) return false;
  if (!lidar.waiting.empty() && lidar.waiting.back().middle() >= reference.middle()) return true;

  const Duration period = lidar.period;
  const Timestamp next_begins = lidar.turns->underWaySince().value_or(*lidar.newest_turn_began + period);
  const Duration next_distance = next_begins + period / 2 - reference.middle();
  return !lidar.waiting.empty() && next_distance >= distance(lidar.waiting.back(), reference);
}

/** The oldest turn of lidar 0 and, of every other lidar, the nearest one; older ones are dropped. */
WholeTurns::ChosenTurns WholeTurns::chooseNearest()
{
  ChosenTurns chosen(lidars_.size());
  const auto take = [&](LidarIndex i)
  {
    chosen[i] = std::move(lidars_[i].waiting.front());
    lidars_[i].waiting.pop_front();
  };
  take(0);
  const Turn& reference = *chosen[0];
  for (LidarIndex i = 1; i < lidars_.size(); ++i)
  {
    Lidar& lidar = lidars_[i];
    const auto nearest =
        std::min_element(lidar.waiting.begin(), lidar.waiting.end(),
                         [&](const Turn& a, const Turn& b) { return distance(a, reference) < distance(b, reference); });
    const Duration longest = std::max(lidar.period, lidars_[0].period);
    const bool near =
        nearest != lidar.waiting.end() && seconds(distance(*nearest, reference)) <= kNearestAtMost * seconds(longest);
    const Timestamp older_than = near ? nearest->middle() : reference.middle();
    while (!lidar.waiting.empty() && lidar.waiting.front().middle() < older_than) drop(lidar);
    if (near) take(i);
  }
  return chosen;
}

void WholeTurns::addToSet(LidarIndex index, Turn turn, std::vector<Scan>& scans)
{
  if (set_[index] || (set_began_ && turn.last >= *set_began_ + kLongestSet)) releaseSet(scans);
  if (!set_began_) set_began_ = turn.last;
  set_[index] = std::move(turn);
  if (std::all_of(set_.begin(), set_.end(), [](const auto& t) { return t.has_value(); })) releaseSet(scans);
}

void WholeTurns::releaseSet(std::vector<Scan>& scans)
{
  if (!set_began_) return;
  scans.push_back(concatenate(std::exchange(set_, ChosenTurns(lidars_.size()))));
  set_began_.reset();
}

Scan WholeTurns::concatenate(ChosenTurns turns)
{
  Scan scan;
  scan.columns_of.assign(lidars_.size(), 0);
  scan.start = Timestamp::max();
  Timestamp end = Timestamp::min();
  std::size_t points = 0;
  for (LidarIndex i = 0; i < turns.size(); ++i)
  {
    if (!turns[i] || !turns[i]->whole) scan.missing.set(i);
    if (!turns[i]) continue;
    scan.start = std::min(scan.start, turns[i]->first);
    end = std::max(end, turns[i]->last + inputs_[i].decoder->description().blockPeriod());
    points += turns[i]->points.size();
  }
  scan.period = end - scan.start;
  scan.points.reserve(points);

  for (LidarIndex i = 0; i < turns.size(); ++i)
  {
    if (!turns[i]) continue;
    const auto first_point = static_cast<std::uint32_t>(scan.points.size());
    const auto later = static_cast<std::int32_t>((turns[i]->origin - scan.start).count());
    for (Column column : turns[i]->columns)
    {
      column.first_point += first_point;
      scan.columns.push_back(column);
    }
    scan.points.append(turns[i]->points);
    for (std::size_t p = first_point; p < scan.points.size(); ++p) scan.points.t[p] += later;
    scan.columns_of[i] = static_cast<std::uint32_t>(turns[i]->columns.size());
    lidars_[i].counters.emitted += turns[i]->columns.size();
    lidars_[i].counters.points += turns[i]->points.size();
  }
  return scan;
}

void WholeTurns::drop(Lidar& lidar)
{
  lidar.counters.dropped += lidar.waiting.front().columns.size();
  lidar.waiting.pop_front();
}

std::optional<Timestamp> WholeTurns::horizon() const
{
  Timestamp oldest = Timestamp::max(), newest = Timestamp::min();
  Duration longest{0};
  for (LidarIndex i = 0; i < lidars_.size(); ++i)
  {
    const Lidar& lidar = lidars_[i];
    const std::optional<Timestamp> under_way = lidar.turns->underWaySince();
    if (!under_way && !lidar.newest_turn_began) continue;
    newest = std::max(newest, under_way.value_or(lidar.heard_until));
    longest = std::max(longest, lidar.period);
    oldest = std::min(oldest, under_way.value_or(lidar.heard_until));
    if (!lidar.waiting.empty()) oldest = std::min(oldest, lidar.waiting.front().first);
    if (set_[i]) oldest = std::min(oldest, set_[i]->first);
  }
  if (newest == Timestamp::min()) return std::nullopt;
  return std::max(oldest, newest - static_cast<int>(kTurnsThatWait) * longest);
}
}  // namespace scanloom
