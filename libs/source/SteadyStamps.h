#pragma once
#include "core/Time.h"

#include <cstdint>

namespace scanloom
{
/** Both clocks of the host at one instant. */
struct HostClocks
{
  Timestamp realtime;  // CLOCK_REALTIME: what the kernel stamps datagrams with; NTP or a person may set it
  Duration monotonic;  // CLOCK_MONOTONIC: never set, slewed like the other

  /** Reads them again until no interruption lies between (a few times at most). */
  static HostClocks now();
};

/**
 * Kernel stamps on a clock that starts as CLOCK_REALTIME and never steps: a deadline must not fire because somebody set
 * the host's clock. Observe the clocks after each reception, before the stamps of what was received are asked for.
 */
class SteadyStamps
{
 public:
  explicit SteadyStamps(const HostClocks& start);

  void observe(const HostClocks&);

  /** Steady time of an instant. */
  Timestamp at(const HostClocks& clocks) const { return fromNanoseconds((start_ + clocks.monotonic).count()); }

  /**
   * `kernel_stamp` on the steady clock. One that was waiting in the socket when the clock was set is told by what is
   * possible: not before `earliest` (the stamp before it on that socket), not after `latest` (now). One that nothing
   * explains becomes `latest`.
   */
  Timestamp steady(Timestamp kernel_stamp, Timestamp earliest, Timestamp latest) const;

  std::uint64_t steps() const { return steps_; }

 private:
  Duration start_;     // CLOCK_REALTIME - CLOCK_MONOTONIC at the start, which is kept
  Duration current_;   // now
  Duration previous_;  // before the latest step
  std::uint64_t steps_ = 0;
};
}  // namespace scanloom
