#include "input/batching/internal/LidarClocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace scanloom
{
namespace
{
// Lidars share a clock if their packets' delays (arrival minus stamp) differ by less.
constexpr Duration kMaxSkew = 100ms;

// Packets of one switch have the same delay to within this: two clock readings that are closer are taken as equal.
constexpr Duration kSameDelay = 2ms;

// F13: a person should know of a drift before it shows in the map.
constexpr Duration kDriftAlarm = 5ms;

// Others are compared with a lidar only if it has sent within this time.
constexpr Duration kActiveWithin = 2s;

/** Whether a clock that has just stepped was nearer to the others before: then the step is undone in its stamps. */
bool isNearerWithout(Duration step, const LidarClock& clock, Duration skew, Duration expected)
{
  const Duration skew_before = *clock.leastDelay() + step - expected;
  return std::chrono::abs(skew) > std::max(std::chrono::abs(skew_before), kSameDelay);
}
}  // namespace

LidarClocks::LidarClocks(const std::vector<BatchedLidar>& lidars, const BatcherOptions& options)
  : other_clock_(otherClockFromName(options.other_clock))
{
  for (const BatchedLidar& lidar : lidars)
  {
    names_.push_back(lidar.name);
    clocks_.emplace_back(lidar.time_offset);
  }
}

std::vector<std::optional<Duration>> LidarClocks::configuredDelays(const std::vector<bool>& accepted) const
{
  std::vector<std::optional<Duration>> delays;
  for (LidarIndex i = 0; i < clocks_.size(); ++i)
    delays.push_back(accepted[i] ? clocks_[i].configuredDelay() : std::nullopt);
  return delays;
}

std::vector<std::optional<Duration>> LidarClocks::skewsAtStart(const std::vector<bool>& accepted) const
{
  std::vector<std::optional<Duration>> skews = clockSkews(configuredDelays(accepted), kMaxSkew);
  if (other_clock_ == OtherClock::Quarantine)
    for (auto& skew : skews)
      if (skew && *skew != Duration{0}) skew.reset();
  return skews;
}

std::vector<LidarClocks::Change> LidarClocks::settleAtStart(const std::vector<bool>& accepted, Timestamp now)
{
  std::vector<Change> changes;
  const auto skews = clockSkews(configuredDelays(accepted), kMaxSkew);
  for (LidarIndex i = 0; i < clocks_.size(); ++i)
  {
    if (!skews[i]) continue;
    LidarClock& clock = clocks_[i];
    if (*skews[i] == Duration{0})
    {
      clock.setCommon();
      continue;
    }
    if (other_clock_ == OtherClock::Refuse)
      throw std::runtime_error(
          fmt::format("lidar '{}': its clock is {:+.6f} s off that of the others: synchronise them (PTP), give its "
                      "time_offset, or set other_clock = align",
                      names_[i], -seconds(*skews[i])));
    if (other_clock_ == OtherClock::Align)
    {
      clock.setOwn(clock.configuredOffset() + *skews[i], now);
      changes.push_back({i, Notice::Kind::ClockAligned, clock.offset()});
    }
    else
    {
      clock.setQuarantined();
      changes.push_back({i, Notice::Kind::Quarantined, -*skews[i]});
    }
  }
  return changes;
}

std::optional<LidarClocks::Change> LidarClocks::settle(LidarIndex lidar, std::optional<Duration> step, Timestamp now)
{
  LidarClock& clock = clocks_[lidar];
  if (clock.state() != LidarClock::State::Unknown) return std::nullopt;
  const std::optional<Duration> expected = commonDelay(lidar, now);
  const Duration skew = expected ? *clock.configuredDelay() - *expected : Duration{0};
  if (!expected || (std::chrono::abs(skew) <= kMaxSkew && !(step && isNearerWithout(*step, clock, skew, *expected))))
  {
    clock.setCommon();
    return std::nullopt;
  }
  if (other_clock_ == OtherClock::Align)
  {
    // The ids tell a step to the microsecond, times of arrival tell a skew only to the network's jitter.
    clock.setOwn(step ? clock.offset() - *step : clock.configuredOffset() + skew, now);
    return Change{lidar, Notice::Kind::ClockAligned, clock.offset()};
  }
  clock.setQuarantined();
  return Change{lidar, Notice::Kind::Quarantined, -skew};
}

std::optional<Duration> LidarClocks::watch(LidarIndex lidar, Timestamp now)
{
  const std::optional<LidarIndex> other = reference(lidar, now);
  if (!other) return std::nullopt;
  LidarClock& clock = clocks_[lidar];
  const Duration expected = *clocks_[*other].leastDelay();
  // Of two clocks that can only be compared with each other, the one of the smaller index leads.
  if (clocks_[*other].state() == LidarClock::State::Common || *other < lidar) clock.follow(expected, now);
  const std::optional<Duration> drift = clock.drift(expected, kDriftAlarm, now);
  return *other < lidar ? drift : std::nullopt;
}

std::optional<Duration> LidarClocks::leastDelay() const
{
  std::optional<Duration> least;
  for (const LidarClock& clock : clocks_)
    if (const auto delay = clock.isUsed() ? clock.leastDelay() : std::nullopt)
      least = std::min(least.value_or(*delay), *delay);
  return least;
}

/** The lidar that another one is compared with: the first that has sent lately, of the common clock if there is one. */
std::optional<LidarIndex> LidarClocks::reference(LidarIndex other_than, Timestamp now) const
{
  for (const LidarClock::State state : {LidarClock::State::Common, LidarClock::State::Own})
    for (LidarIndex i = 0; i < clocks_.size(); ++i)
      if (i != other_than && clocks_[i].state() == state && clocks_[i].hasSentSince(now - kActiveWithin)) return i;
  return std::nullopt;
}

/**
 * The least delay of packets stamped by the common clock: now, or when that clock was last known. A lidar that sends
 * first after all others were left out or fell silent must not begin another time. None if no clock was ever common.
 */
std::optional<Duration> LidarClocks::commonDelay(LidarIndex lidar, Timestamp now) const
{
  if (const auto other = reference(lidar, now)) return clocks_[*other].leastDelay();
  if (const auto own = clocks_[lidar].delayBeforeBreak()) return own;
  for (const LidarClock& clock : clocks_)
    if (clock.isUsed()) return clock.leastDelay();
  for (const LidarClock& clock : clocks_)
    if (const auto before = clock.delayBeforeBreak()) return before;
  return std::nullopt;
}
}  // namespace scanloom
