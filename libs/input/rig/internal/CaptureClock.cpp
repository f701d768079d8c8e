#include "input/rig/internal/CaptureClock.h"

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
  const std::optional<Timestamp> stamp = packet.firstStamp();
  if (!stamp) return packet.received - step_;

  const Times now{*stamp, packet.received};
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
