/** Time stamps of sensors: integer nanoseconds, never a double. */
#pragma once
#include <chrono>
#include <cstdint>

namespace scanloom
{
using namespace std::chrono_literals;

using Duration = std::chrono::nanoseconds;

/** The common clock of a recording: nanoseconds since its epoch (Unix time if the sensors use PTP). */
struct SensorClock
{
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<SensorClock>;
  static constexpr bool is_steady = false;  // NOLINT(readability-identifier-naming): the standard names it
};
using Timestamp = SensorClock::time_point;

constexpr double seconds(Duration d) { return 1e-9 * static_cast<double>(d.count()); }

/** Rounds to the nearest nanosecond. */
constexpr Duration fromSeconds(double s) { return Duration{static_cast<std::int64_t>(s * 1e9 + (s < 0 ? -0.5 : 0.5))}; }

constexpr std::int64_t nanoseconds(Timestamp t) { return t.time_since_epoch().count(); }
constexpr Timestamp fromNanoseconds(std::int64_t ns) { return Timestamp{Duration{ns}}; }
}  // namespace scanloom
