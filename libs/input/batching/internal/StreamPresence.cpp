#include "input/batching/internal/StreamPresence.h"

#include "input/batching/Continuity.h"
#include "input/batching/PacketNumbering.h"

#include <algorithm>

namespace scanloom
{
namespace
{
// Longer than bursts of unknown senders.
constexpr Duration kWhile = 25ms;

// A lidar of which few packets arrive is accepted only after a longer while.
constexpr Duration kLongWhile = 1s, kLongestWhile = 10s;

// Longer than the pause of a lidar at 5 Hz with a narrow azimuth window.
constexpr Duration kLongestPause = 200ms;

// More than a network's jitter: one of two successive packets has a stamp of another clock.
constexpr Duration kDelaysDiffer = 50ms;

// Of the packets that the lidar sends, one in so many must arrive: in a while, in a long while.
constexpr int kThin = 4, kThinnest = 16;
}  // namespace

StreamPresence::StreamPresence(const LidarDescription& lidar, Duration scan_period)
  : while_(std::min(kWhile, scan_period))
{
  const PacketNumbering numbering(numberedTurn(lidar));
  const std::int64_t all = numbering.packetsPerTurn();
  const std::int64_t sent = std::max<std::int64_t>(numbering.sentBefore(all), 1);
  packet_every_ = all * lidar.columns_per_packet * lidar.blockPeriod() / sent;
}

bool StreamPresence::note(Timestamp stamp, Timestamp received)
{
  const Duration delay = received - stamp;
  const bool contradicts = stream_ && std::chrono::abs(delay - stream_->delay) > kDelaysDiffer;
  if (!stream_ || contradicts) stream_ = Stream{received, received, delay, 0};
  stream_->latest = std::max(stream_->latest, received);
  stream_->delay = delay;
  ++stream_->packets;
  return !contradicts;
}

bool StreamPresence::isEstablished() const
{
  if (!stream_) return false;
  const Duration length = stream_->latest - stream_->first;
  const auto isDense = [&](int one_in) { return one_in * stream_->packets * packet_every_ >= length; };
  return length >= kLongestWhile || (length >= kLongWhile && isDense(kThinnest)) ||
         (length >= while_ && isDense(kThin));
}

bool StreamPresence::isStarting(Timestamp now) const { return stream_ && now - stream_->first < kLongWhile; }

bool StreamPresence::isLost(Timestamp now) const { return stream_ && now - stream_->latest > kLongestPause; }
}  // namespace scanloom
