#include "batching/Sequencer.h"

#include <algorithm>

namespace scanloom
{
namespace
{
// A rotor keeps its speed to a small part of this; a prediction over a closed window must stay a lower bound.
constexpr double kRotorTolerance = 0.005;

// A packet that is further back than this many turns is no reordered one: the lidar has started again.
constexpr int kTurnsRemembered = 4;
}  // namespace

PacketNumbering::PacketNumbering(const LidarDescription& lidar)
{
  const int columns = lidar.columns_per_frame;
  const auto inWindow = [&lidar](int column)
  {
    return lidar.first_column <= lidar.last_column ? column >= lidar.first_column && column <= lidar.last_column
                                                   : column >= lidar.first_column || column <= lidar.last_column;
  };
  sent_before_.push_back(0);
  for (int first = 0; first < columns; first += lidar.columns_per_packet)
  {
    bool sent = false;
    for (int c = first; c < std::min(first + lidar.columns_per_packet, columns); ++c) sent |= inWindow(c);
    sent_before_.push_back(sent_before_.back() + (sent ? 1 : 0));
  }
  for (int column = 0; column < columns; ++column)
  {
    int blocks = 1;
    while (blocks < columns && !inWindow((column + blocks) % columns)) ++blocks;
    blocks_to_next_.push_back(blocks);
  }
}

std::int64_t PacketNumbering::sentBefore(std::int64_t number) const
{
  const std::int64_t turn = number >= 0 ? number / packetsPerTurn() : (number + 1) / packetsPerTurn() - 1;
  return turn * sent_before_.back() + sent_before_[static_cast<std::size_t>(number - turn * packetsPerTurn())];
}

Sequencer::Sequencer(const LidarDescription& lidar, Duration deadline)
  : numbering_(lidar),
    block_period_(lidar.blockPeriod()),
    deadline_(deadline),
    frame_id_modulus_(lidar.frame_id_modulus),
    columns_per_packet_(lidar.columns_per_packet)
{
}

Sequencer::Verdict Sequencer::accept(const PacketHeader& header, const MeasurementBlock& last, Timestamp received)
{
  const bool other_run = header.init_id && init_id_ && *header.init_id != *init_id_;
  if (header.init_id) init_id_ = header.init_id;

  const std::int64_t packets_per_turn = numbering_.packetsPerTurn();
  const std::int64_t in_turn = last.measurement_id / columns_per_packet_;
  const std::int64_t frame = newest_ ? unwrap(last.frame_id) : last.frame_id;
  const std::int64_t number = frame * packets_per_turn + in_turn;
  const bool far_away = newest_ && std::abs(number - *newest_) > kTurnsRemembered * packets_per_turn;
  const Arrived arrived{earliestAfter(last), received};

  if (!newest_ || other_run || far_away)
  {
    const bool first_ever = !newest_;
    const std::int64_t restarted_at = last.frame_id * packets_per_turn + in_turn;
    restart(restarted_at, last.frame_id);
    after_gap_[restarted_at] = arrived;
    recent_.insert(restarted_at);
    advance(std::nullopt);
    return first_ever ? Verdict::New : Verdict::Restarted;
  }
  if (!recent_.insert(number).second) return Verdict::Duplicate;
  recent_.erase(recent_.begin(), recent_.lower_bound(*newest_ - kTurnsRemembered * packets_per_turn));
  newest_frame_ = std::max(newest_frame_, frame);
  if (number <= *newest_) return number >= first_ ? Verdict::Recovered : Verdict::New;
  after_gap_[number] = arrived;
  advance(std::nullopt);
  return Verdict::New;
}

Timestamp Sequencer::earliestAfter(const MeasurementBlock& last) const
{
  if (last.stamp == Timestamp::min()) return last.stamp;
  return last.stamp + fromSeconds((numbering_.blocksToNext(last.measurement_id) - 0.5) * (1 - kRotorTolerance) *
                                  seconds(block_period_));
}

void Sequencer::restart(std::int64_t number, std::uint32_t frame_id)
{
  after_gap_.clear();
  recent_.clear();
  watermark_.reset();
  newest_frame_ = frame_id;
  newest_ = number - 1;
  first_ = number;
}

std::int64_t Sequencer::unwrap(std::uint32_t frame_id) const
{
  const auto modulus = static_cast<std::int64_t>(frame_id_modulus_);
  std::int64_t ahead = (static_cast<std::int64_t>(frame_id) - newest_frame_) % modulus;
  if (ahead < -modulus / 2) ahead += modulus;
  if (ahead >= modulus / 2) ahead -= modulus;
  return newest_frame_ + ahead;
}

std::uint64_t Sequencer::giveUpGaps(Timestamp now) { return advance(now - deadline_); }

std::uint64_t Sequencer::finish() { return advance(Timestamp::max()); }

std::uint64_t Sequencer::advance(std::optional<Timestamp> give_up_shown_until)
{
  std::uint64_t lost = 0;
  while (!after_gap_.empty())
  {
    const auto [number, arrived] = *after_gap_.begin();
    const std::int64_t missing = numbering_.sentBefore(number) - numbering_.sentBefore(*newest_ + 1);
    if (missing > 0 && !(give_up_shown_until && arrived.received <= *give_up_shown_until)) break;
    lost += static_cast<std::uint64_t>(std::max<std::int64_t>(missing, 0));
    newest_ = number;
    watermark_ = std::max(watermark_.value_or(Timestamp::min()), arrived.earliest_next);
    after_gap_.erase(after_gap_.begin());
  }
  return lost;
}
}  // namespace scanloom
