#pragma once
#include "base/core/Time.h"

#include <cstdint>

namespace scanloom
{
/** Both clocks of the host, read at the same time. */
struct HostClocks
{
  Timestamp realtime;  // CLOCK_REALTIME: the kernel's stamps of datagrams; NTP or a person may set it
  Duration monotonic;  // CLOCK_MONOTONIC: never set, but slewed like CLOCK_REALTIME

  /** Reads both a few times and takes the reading with the least delay between them. */
  static HostClocks now();
};

/**
 * Converts kernel stamps to a clock that starts as CLOCK_REALTIME and never steps: deadlines must not pass because the
 * host's clock was set. Call observe() after each reception, before steady() of what was received.
 */
class SteadyStamps
{
 public:
  explicit SteadyStamps(const HostClocks& start);

  void observe(const HostClocks&);

  /** The time of the steady clock. */
  Timestamp at(const HostClocks& clocks) const { return fromNanoseconds((start_ + clocks.monotonic).count()); }

  /**
   * `kernel_stamp` on the steady clock, between `earliest` (the previous stamp of that socket) and `latest` (now). If
   * it is not within these by the current offset, that before the last step is tried, then `latest` is returned.
   */
  Timestamp steady(Timestamp kernel_stamp, Timestamp earliest, Timestamp latest) const;

  /** How often the host's clock was set. */
  std::uint64_t steps() const { return steps_; }

 private:
  Duration start_;     // CLOCK_REALTIME - CLOCK_MONOTONIC at the start
  Duration current_;   // now
  Duration previous_;  // before the latest step
  std::uint64_t steps_ = 0;
};
}  // namespace scanloom
