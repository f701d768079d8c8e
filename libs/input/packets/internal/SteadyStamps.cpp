#include "input/packets/internal/SteadyStamps.h"

#include <time.h>

#include <algorithm>

namespace scanloom
{
namespace
{
// Smaller steps are ignored: they harm no deadline, and on a busy machine the clocks cannot be compared better.
constexpr Duration kLeastStep = 200us;

// If two readings of the monotonic clock around one of the other differ by more, the thread was interrupted.
constexpr Duration kUndisturbed = 20us;
constexpr int kAttempts = 5;

// The kernel stamps a datagram before it is in the socket: with several processors, stamps may be out of order by this.
constexpr Duration kSlack = 1ms;

Duration read(clockid_t clock)
{
  timespec t{};
  clock_gettime(clock, &t);
  return std::chrono::seconds(t.tv_sec) + Duration(t.tv_nsec);
}

Duration offsetOf(const HostClocks& clocks) { return clocks.realtime.time_since_epoch() - clocks.monotonic; }
}  // namespace

HostClocks HostClocks::now()
{
  HostClocks best{};
  Duration least = Duration::max();
  for (int i = 0; i < kAttempts && least > kUndisturbed; ++i)
  {
    const Duration before = read(CLOCK_MONOTONIC);
    const Timestamp realtime{read(CLOCK_REALTIME)};
    const Duration after = read(CLOCK_MONOTONIC);
    if (after - before >= least) continue;
    least = after - before;
    best = {realtime, before + least / 2};
  }
  return best;
}

SteadyStamps::SteadyStamps(const HostClocks& start)
  : start_(offsetOf(start)), current_(offsetOf(start)), previous_(offsetOf(start))
{
}

void SteadyStamps::observe(const HostClocks& clocks)
{
  const Duration offset = offsetOf(clocks);
  if (std::chrono::abs(offset - current_) < kLeastStep) return;
  previous_ = current_;
  current_ = offset;
  ++steps_;
}

Timestamp SteadyStamps::steady(Timestamp kernel_stamp, Timestamp earliest, Timestamp latest) const
{
  for (const Duration offset : {current_, previous_})
  {
    const Timestamp steady = kernel_stamp - offset + start_;
    if (steady + kSlack >= earliest && steady <= latest + kSlack) return std::min(steady, latest);
  }
  return latest;
}
}  // namespace scanloom
