#pragma once
#include "base/core/Time.h"
#include "input/batching/internal/SlidingMinimum.h"

#include <optional>
#include <vector>

namespace scanloom
{
/**
 * One lidar's clock, to be compared with the others. The delay of a packet is its arrival by host time minus its stamp;
 * the least delay of the last two seconds changes only if a clock drifts or steps.
 */
class LidarClock
{
 public:
  enum class State
  {
    Unknown,      // no packet has come yet, or the clock is not compared yet
    Common,       // shared with the others: only the configured offset is added to stamps
    Own,          // not shared: the offset comes from times of arrival and follows the clock's drift
    Quarantined,  // not shared, and the lidar is left out
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

  /** Least delay on the common clock before the latest step or restart; none if there was none, or it was not used. */
  std::optional<Duration> delayBeforeBreak() const { return delay_before_break_; }

  bool hasSentSince(Timestamp) const;
  bool isUsed() const { return state_ == State::Common || state_ == State::Own; }

  void setCommon();
  void setOwn(Duration offset, Timestamp now);
  void setQuarantined() { state_ = State::Quarantined; }

  /** The clock must be compared again. After a step the known delays are corrected; after a restart none is known. */
  void stepped(Duration step);
  void restarted();

  /** Moves the offset of an Own clock towards the delay of the others, so slowly that its stamps never go back. */
  void follow(Duration others_delay, Timestamp now);

  /**
   * For a Common clock: by how much it has drifted against the others since the start or the last alarm, if by `alarm`
   * or more. At most once in ten seconds: on a busy computer the packets' delays go up and down.
   */
  std::optional<Duration> drift(Duration others_delay, Duration alarm, Timestamp now);

 private:
  Duration configured_;
  Duration offset_;
  State state_ = State::Unknown;
  SlidingMinimum delays_{2s};                   // of raw stamps
  std::optional<Duration> skew_at_last_alarm_;  // or at the start
  std::optional<Timestamp> last_alarm_;
  std::optional<Duration> delay_before_break_;
  Timestamp settled_, followed_;  // when the offset was set and last moved; for Own
};

/**
 * From least delays: what must be added to each lidar's stamps so that they agree with the common clock. That is the
 * clock of the largest group of lidars whose neighbouring delays differ by `max_skew` at most (of equally large groups:
 * the one nearest to host time); 0 for its members, none for a lidar without a delay.
 */
std::vector<std::optional<Duration>> clockSkews(const std::vector<std::optional<Duration>>& delays, Duration max_skew);
}  // namespace scanloom
