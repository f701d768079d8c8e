#include "input/batching/internal/Sequencer.h"

#include "input/batching/Continuity.h"

#include <algorithm>
#include <limits>

namespace scanloom
{
namespace
{
// Rotors keep their speed far better; the predicted start of the next azimuth window must be a lower bound.
constexpr double kRotorTolerance = 0.005;

// For how long a duplicate is recognised.
constexpr std::size_t kTurnsRemembered = 4;

constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();
}  // namespace

Sequencer::Sequencer(const LidarDescription& lidar, Duration deadline)
  : numbering_(numberedTurn(lidar)),
    deadline_(deadline),
    recent_(kTurnsRemembered * static_cast<std::size_t>(numbering_.packetsPerTurn()), kNone)
{
}

Sequencer::Verdict Sequencer::accept(const Place& place, Timestamp received)
{
  const std::int64_t packet = numbering_.packetOf(place.block);
  if (!newest_) restart(place.block);
  if (isRepeated(packet)) return Verdict::Duplicate;
  if (packet <= *newest_) return packet >= first_ ? Verdict::Recovered : Verdict::New;

  const Arrived arrived{earliestAfter(place), received};
  if (after_gap_.empty() && missingBefore(packet) <= 0)
    goOnAfter(packet, arrived);
  else
  {
    after_gap_[packet] = arrived;
    advance(Timestamp::min());
  }
  return Verdict::New;
}

bool Sequencer::isRepeated(std::int64_t packet)
{
  const auto size = static_cast<std::int64_t>(recent_.size());
  std::int64_t& slot = recent_[static_cast<std::size_t>(((packet % size) + size) % size)];
  if (slot == packet) return true;
  // Older than all that is remembered: it may be a duplicate, so it is taken for one.
  if (slot != kNone && slot > packet) return true;
  slot = packet;
  return false;
}

std::optional<Timestamp> Sequencer::earliestAfter(const Place& place) const
{
  if (!place.stamp) return std::nullopt;
  const double blocks = (numbering_.blocksToNext(place.block) - 0.5) * (1 - kRotorTolerance);
  return *place.stamp + fromSeconds(blocks * seconds(place.block_period));
}

std::uint64_t Sequencer::restart(std::int64_t block)
{
  const std::uint64_t lost = finish();
  std::fill(recent_.begin(), recent_.end(), kNone);
  watermark_.reset();
  first_ = numbering_.packetOf(block);
  newest_ = first_ - 1;
  return lost;
}

void Sequencer::shift(Duration step)
{
  if (watermark_) *watermark_ += step;
  for (auto& [packet, arrived] : after_gap_)
    if (arrived.earliest_next) *arrived.earliest_next += step;
}

std::uint64_t Sequencer::giveUpGaps(Timestamp now) { return after_gap_.empty() ? 0 : advance(now - deadline_); }

std::uint64_t Sequencer::finish() { return advance(Timestamp::max()); }

std::int64_t Sequencer::missingBefore(std::int64_t packet) const
{
  return numbering_.sentBefore(packet) - numbering_.sentBefore(*newest_ + 1);
}

void Sequencer::goOnAfter(std::int64_t packet, const Arrived& arrived)
{
  newest_ = packet;
  if (arrived.earliest_next) watermark_ = std::max(watermark_.value_or(Timestamp::min()), *arrived.earliest_next);
}

std::uint64_t Sequencer::advance(Timestamp give_up_before)
{
  std::uint64_t lost = 0;
  while (!after_gap_.empty())
  {
    const auto [packet, arrived] = *after_gap_.begin();
    const std::int64_t missing = missingBefore(packet);
    if (missing > 0 && arrived.received > give_up_before) break;
    lost += static_cast<std::uint64_t>(std::max<std::int64_t>(missing, 0));
    goOnAfter(packet, arrived);
    after_gap_.erase(after_gap_.begin());
  }
  return lost;
}
}  // namespace scanloom
