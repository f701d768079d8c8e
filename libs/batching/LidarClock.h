#pragma once
#include "batching/SlidingMinimum.h"
#include "core/Time.h"

#include <optional>
#include <vector>

namespace scanloom
{
/**
 * One lidar's clock against the others', judged by the host's: the delay of a packet is its arrival minus its stamp,
 * and the least delay of the last two seconds changes only as the clocks drift or step.
 */
class LidarClock
{
 public:
  enum class State
  {
    Unknown,      // not heard, or not compared with the others yet
    Common,       // the others' clock: only the configured offset is added
    Own,          // aligned by times of arrival, and followed as it drifts
    Quarantined,  // not used
  };

  explicit LidarClock(Duration configured_offset) : configured_(configured_offset), offset_(configured_offset) {}

  State state() const { return state_; }

  /** What is added to the lidar's stamps. */
  Duration offset() const { return offset_; }
  Duration configuredOffset() const { return configured_; }

  /** A packet with this newest stamp, by the lidar's own clock. */
  void observe(Timestamp stamp, Timestamp received);

  /** Least delay of stamps on the common clock; none before the first packet. */
  std::optional<Duration> leastDelay() const
  {
    const std::optional<Duration> delay = delays_.value();
    return delay ? std::optional(*delay - offset_) : std::nullopt;
  }

  /** Least delay if only the configured offset were added; none before the first packet. */
  std::optional<Duration> configuredDelay() const;

  /** Least delay on the common clock before the step or restart that ended its latest use; none if it was never used.
   */
  std::optional<Duration> delayBeforeBreak() const { return delay_before_break_; }

  bool heardSince(Timestamp) const;
  bool isUsed() const { return state_ == State::Common || state_ == State::Own; }

  void setCommon();
  void setOwn(Duration offset, Timestamp now);
  void setQuarantined() { state_ = State::Quarantined; }

  /** To be compared again. After a step the delays are known but for the step; after a restart nothing is. */
  void stepped(Duration step);
  void restarted();

  /** An Own clock is led to the delay that the others have, slowly enough that its stamps never go back. */
  void follow(Duration others_delay, Timestamp now);

  /**
   * For a common clock: by how much it has moved against the others' since the start or the last alarm, if by more than
   * `alarm`. Not twice in ten seconds: on a computer that is short of time, packets' delays go up and down.
   */
  std::optional<Duration> drift(Duration others_delay, Duration alarm, Timestamp now);

 private:
  Duration configured_;
  Duration offset_;
  State state_ = State::Unknown;
  SlidingMinimum delays_{2s};  // of raw stamps
  std::optional<Duration> skew_watched_;
  Timestamp no_alarm_before_ = Timestamp::min();
  std::optional<Duration> delay_before_break_;
  Timestamp decided_ = Timestamp::min();
  Timestamp followed_ = Timestamp::min();
};

/**
 * How far each lidar's clock is behind that of the largest group that agrees within `max_skew` (of equal groups: the
 * one nearest to the host's clock): 0 for its members, what must be added to its stamps for the others, nothing for
 * those not heard. `delays` are least delays.
 */
std::vector<std::optional<Duration>> clockSkews(const std::vector<std::optional<Duration>>& delays, Duration max_skew);
}  // namespace scanloom
