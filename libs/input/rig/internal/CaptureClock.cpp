#include "input/rig/internal/CaptureClock.h"

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
// Networks delay packets by less, and after a smaller step deadlines are wrong for two seconds at most.
constexpr Duration kLeastStep = 500ms;
}  // namespace

Timestamp CaptureClock::steady(const RoutedPacket& packet)
{
  const auto valid = std::find_if(packet.blocks.begin(), packet.blocks.end(), [](const auto& b) { return b.valid; });
  if (valid == packet.blocks.end()) return packet.received - step_;

  const Times now{valid->stamp, packet.received};
  std::optional<Times>& last = last_[packet.lidar];
  const bool jumps = newest_ && std::chrono::abs(now.received - *newest_) >= kLeastStep;
  if (jumps && last && std::chrono::abs(now.stamp - last->stamp) < kLeastStep)
  {
    step_ += (now.received - last->received) - (now.stamp - last->stamp);
    has_stepped_ = true;
  }
  last = now;
  newest_ = now.received;
  return packet.received - step_;
}

std::optional<Duration> CaptureClock::takeStep()
{
  return std::exchange(has_stepped_, false) ? std::optional(step_) : std::nullopt;
}
}  // namespace scanloom
