// When the first scan starts, eq. (1), and which clock counts: the parts of TimeBatcher that compare the lidars.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "batching/TimeBatcher.h"

namespace scanloom
{
namespace
{
// Packets of one switch are delayed alike to within this: nearer than that two readings of a clock are the same.
constexpr Duration kSameDelay = 2ms;

// F13: a person should hear of a drift before it shows in the map.
constexpr Duration kDriftAlarm = 5ms;

// A lidar that was heard within this may tell the time.
constexpr Duration kHeardLately = 2s;

Duration magnitude(Duration d) { return d < Duration{0} ? -d : d; }
Duration floorMod(Duration a, Duration b) { return (a % b + b) % b; }
}  // namespace

/** How far each lidar heard so far is off the common clock; nothing for those not heard or not wanted. */
std::vector<std::optional<Duration>> TimeBatcher::skewsAtStart() const
{
  std::vector<std::optional<Duration>> delays;
  for (const LidarInput& input : inputs_) delays.push_back(input.clock.configuredDelay());
  std::vector<std::optional<Duration>> skews = clockSkews(delays, max_clock_skew_);
  if (other_clock_ == OtherClock::Quarantine)
    for (auto& skew : skews)
      if (skew && *skew != Duration{0}) skew.reset();
  return skews;
}

/**
 * t_0,max of eq. (1), once it is certain. A lidar that is silent is waited for one period, which costs nothing (no full
 * scan could be over sooner); one that starts after that joins later, the grid being absolute.
 */
std::optional<Timestamp> TimeBatcher::latestFirstStamp() const
{
  const auto skews = skewsAtStart();
  std::vector<std::optional<Timestamp>> firsts;
  Timestamp earliest = Timestamp::max();
  Duration quickest = Duration::max();
  for (LidarIndex i = 0; i < inputs_.size(); ++i)
  {
    const auto first = skews[i] ? inputs_[i].firstStamp() : std::nullopt;
    firsts.push_back(first ? std::optional(*first + *skews[i]) : std::nullopt);
    if (!firsts[i]) continue;
    earliest = std::min(earliest, *firsts[i]);
    quickest = std::min(quickest, *inputs_[i].clock.leastDelay() - *skews[i]);
  }
  if (earliest == Timestamp::max()) return std::nullopt;

  Timestamp latest = earliest;
  for (LidarIndex i = 0; i < inputs_.size(); ++i)
  {
    const Timestamp first = std::min(firsts[i].value_or(Timestamp::max()), earliest + period_);
    const Duration delay = firsts[i] ? *inputs_[i].clock.leastDelay() - *skews[i] : quickest;
    if (!finished_ && inputs_[i].deadlineAt(now_, delay) < first) return std::nullopt;
    if (firsts[i] == first) latest = std::max(latest, first);
  }
  return latest;
}

void TimeBatcher::startAfter(Timestamp latest)
{
  settleClocksAtStart();
  for (LidarIndex i = 0; i < inputs_.size(); ++i) refreshFront(i);
  first_start_ = latest - floorMod(latest.time_since_epoch() - phase_, period_) + period_;  // eq. (1)
  scan_ = emptyScan(first_start_);
}

void TimeBatcher::settleClocksAtStart()
{
  std::vector<std::optional<Duration>> delays;
  for (const LidarInput& input : inputs_) delays.push_back(input.clock.configuredDelay());
  const auto skews = clockSkews(delays, max_clock_skew_);
  for (LidarIndex i = 0; i < inputs_.size(); ++i)
  {
    if (!skews[i]) continue;
    LidarInput& input = inputs_[i];
    if (*skews[i] == Duration{0})
    {
      input.clock.setCommon();
      continue;
    }
    if (other_clock_ == OtherClock::Refuse)
      throw std::runtime_error(fmt::format(
          "lidar '{}': its clock is {:+.6f} s off that of the others: synchronise them (PTP), give its time_offset, or "
          "set other_clock = align",
          lidars_[i].name, -seconds(*skews[i])));
    if (other_clock_ == OtherClock::Align)
    {
      input.queue.shift(*skews[i]);
      input.clock.setOwn(input.clock.configuredOffset() + *skews[i], now_);
      note(i, Notice::Kind::ClockAligned, input.clock.offset());
    }
    else
    {
      input.counters.quarantined += input.queue.clear();
      input.clock.setQuarantined();
      note(i, Notice::Kind::Quarantined, -*skews[i]);
    }
  }
}

/** The lidar whose packets' delays others are compared with: the first one that is heard, best of the common clock. */
std::optional<LidarIndex> TimeBatcher::clockReference(LidarIndex lidar) const
{
  for (const LidarClock::State state : {LidarClock::State::Common, LidarClock::State::Own})
    for (LidarIndex i = 0; i < inputs_.size(); ++i)
      if (i != lidar && inputs_[i].clock.state() == state && inputs_[i].clock.heardSince(now_ - kHeardLately)) return i;
  return std::nullopt;
}

/**
 * The delay that packets stamped by the common clock have now, or had when that clock was last known: whoever is heard
 * first after all others were left out or fell silent must not begin another time. None if nobody ever told.
 */
std::optional<Duration> TimeBatcher::commonDelay(LidarIndex lidar) const
{
  if (const auto reference = clockReference(lidar)) return inputs_[*reference].clock.leastDelay();
  if (const auto own = inputs_[lidar].clock.delayBeforeBreak()) return own;
  for (const LidarInput& input : inputs_)
    if (input.clock.isUsed()) return input.clock.leastDelay();
  for (const LidarInput& input : inputs_)
    if (const auto before = input.clock.delayBeforeBreak()) return before;
  return std::nullopt;
}

/** A lidar that was first heard after the start, has restarted or whose clock has stepped. */
void TimeBatcher::settleClock(LidarIndex lidar, const std::vector<Notice::Kind>& news)
{
  LidarClock& clock = inputs_[lidar].clock;
  const std::optional<Duration> expected = commonDelay(lidar);
  if (!expected) return clock.setCommon();

  const Duration skew = *clock.configuredDelay() - *expected;
  const bool stepped = std::find(news.begin(), news.end(), Notice::Kind::ClockStepped) != news.end();
  // The ids tell the step to the microsecond, times of arrival only to the network's jitter.
  const Duration continued = clock.offset() - inputs_[lidar].step();
  const Duration skew_if_continued = *clock.leastDelay() + inputs_[lidar].step() - *expected;

  const bool sensor_is_right = !stepped || magnitude(skew) <= std::max(magnitude(skew_if_continued), kSameDelay);
  if (magnitude(skew) <= max_clock_skew_ && sensor_is_right) return clock.setCommon();
  if (other_clock_ == OtherClock::Align)
  {
    clock.setOwn(stepped ? continued : clock.configuredOffset() + skew, now_);
    return note(lidar, Notice::Kind::ClockAligned, clock.offset());
  }
  clock.setQuarantined();
  note(lidar, Notice::Kind::Quarantined, -skew);
}

void TimeBatcher::watchClock(LidarIndex lidar)
{
  const std::optional<LidarIndex> reference = clockReference(lidar);
  if (!reference) return;
  LidarClock& clock = inputs_[lidar].clock;
  const Duration expected = *inputs_[*reference].clock.leastDelay();
  // Of two clocks that only know each other, one must lead.
  if (inputs_[*reference].clock.state() == LidarClock::State::Common || *reference < lidar)
    clock.follow(expected, now_);
  if (const auto drift = clock.drift(expected, kDriftAlarm, now_); drift && *reference < lidar)
    note(lidar, Notice::Kind::ClockDrifts, *drift);
}
}  // namespace scanloom
