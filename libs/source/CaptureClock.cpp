#include "source/CaptureClock.h"

namespace scanloom
{
namespace
{
// Networks hold packets back for less; deadlines that fire over a smaller step harm two seconds at most.
constexpr Duration kLeastStep = 500ms;
}  // namespace

void CaptureClock::observe(LidarIndex lidar, Timestamp stamp, Timestamp received)
{
  std::optional<Packet>& last = last_[lidar];
  const bool jumps = newest_ && std::chrono::abs(received - *newest_) >= kLeastStep;
  if (jumps && last && std::chrono::abs(stamp - last->stamp) < kLeastStep)
  {
    step_ += (received - last->received) - (stamp - last->stamp);
    ++steps_;
  }
  last = Packet{stamp, received};
  newest_ = received;
}
}  // namespace scanloom
