#include "input/batching/internal/LidarClock.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
// Change of the offset per second. Clocks drift by less than 1e-4. The least delay is known only after some seconds:
// until then the offset may change faster, but still so slowly that columns keep their order.
constexpr double kFollowRate = 2e-4;
constexpr double kSettleRate = 1e-2;
constexpr Duration kSettling = 2s;

constexpr Duration kLeastBetweenAlarms = 10s;
}  // namespace

void LidarClock::observe(Timestamp stamp, Timestamp received) { delays_.add(received, received - stamp); }

std::optional<Duration> LidarClock::configuredDelay() const
{
  const std::optional<Duration> delay = delays_.value();
  return delay ? std::optional(*delay - configured_) : std::nullopt;
}

bool LidarClock::hasSentSince(Timestamp when) const { return !delays_.empty() && delays_.newest() >= when; }

void LidarClock::setCommon()
{
  state_ = State::Common;
  offset_ = configured_;
  skew_at_last_alarm_.reset();
}

void LidarClock::setOwn(Duration offset, Timestamp now)
{
  state_ = State::Own;
  offset_ = offset;
  settled_ = followed_ = now;
}

void LidarClock::stepped(Duration step)
{
  if (isUsed()) delay_before_break_ = leastDelay();
  state_ = State::Unknown;
  delays_.shift(-step);
}

void LidarClock::restarted()
{
  if (const auto delay = leastDelay(); delay && isUsed()) delay_before_break_ = delay;
  state_ = State::Unknown;
  delays_.clear();
}

void LidarClock::follow(Duration others_delay, Timestamp now)
{
  const std::optional<Duration> delay = leastDelay();
  if (state_ != State::Own || !delay || now <= followed_) return;
  const double rate = now - settled_ < kSettling ? kSettleRate : kFollowRate;
  const Duration most = fromSeconds(rate * std::min(seconds(now - followed_), 1.0));
  offset_ += std::clamp(*delay - others_delay, -most, most);
  followed_ = now;
}

std::optional<Duration> LidarClock::drift(Duration others_delay, Duration alarm, Timestamp now)
{
  const std::optional<Duration> delay = leastDelay();
  if (state_ != State::Common || !delay) return std::nullopt;
  const Duration skew = *delay - others_delay;
  if (!skew_at_last_alarm_) skew_at_last_alarm_ = skew;
  const Duration drift = skew - *skew_at_last_alarm_;
  if (last_alarm_ && now < *last_alarm_ + kLeastBetweenAlarms) return std::nullopt;
  if (std::chrono::abs(drift) < alarm) return std::nullopt;
  last_alarm_ = now;
  skew_at_last_alarm_ = skew;
  return drift;
}

std::vector<std::optional<Duration>> clockSkews(const std::vector<std::optional<Duration>>& delays, Duration max_skew)
{
  std::vector<Duration> known;
  for (const auto& delay : delays)
    if (delay) known.push_back(*delay);
  std::sort(known.begin(), known.end());

  struct Group
  {
    std::ptrdiff_t size = 0;
    Duration least{0}, greatest{0};
  };
  Group best;
  for (auto first = known.begin(); first != known.end();)
  {
    auto last = first + 1;
    while (last != known.end() && *last - *(last - 1) <= max_skew) ++last;
    const Group group{last - first, *first, *(last - 1)};
    const auto farFromHost = [](const Group& g) { return std::abs(seconds(g.least)); };
    if (group.size > best.size || (group.size == best.size && farFromHost(group) < farFromHost(best))) best = group;
    first = last;
  }

  std::vector<std::optional<Duration>> skews;
  for (const auto& delay : delays)
  {
    if (!delay)
      skews.emplace_back();
    else
      skews.emplace_back(*delay >= best.least && *delay <= best.greatest ? Duration{0} : *delay - best.least);
  }
  return skews;
}
}  // namespace scanloom
