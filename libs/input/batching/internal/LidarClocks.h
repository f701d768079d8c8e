#pragma once
#include "input/batching/internal/BatcherOptions.h"
#include "input/batching/internal/LidarClock.h"
#include "input/batching/internal/Notice.h"

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * Which lidars share a clock, and what is added to the stamps of the others. Clocks are compared by the least delay of
 * their packets: arrival by host time minus stamp.
 */
class LidarClocks
{
 public:
  /** Throws std::invalid_argument for an unknown other_clock. */
  LidarClocks(const std::vector<BatchedLidar>&, const BatcherOptions&);

  LidarClock& operator[](LidarIndex lidar) { return clocks_[lidar]; }
  const LidarClock& operator[](LidarIndex lidar) const { return clocks_[lidar]; }

  /**
   * How far each lidar received so far is behind the common clock, as clockSkews says; none for those not received, and
   * for those whose clock will be quarantined or that are not `accepted`.
   */
  std::vector<std::optional<Duration>> skewsAtStart(const std::vector<bool>& accepted) const;

  struct Change
  {
    LidarIndex lidar = 0;
    Notice::Kind kind = Notice::Kind::ClockAligned;  // or Quarantined
    Duration duration{0};                            // as Notice::duration
  };

  /**
   * Decides for each lidar that sends and is accepted; returns those that are not on the common clock. Throws
   * std::runtime_error for the first of them with other_clock = refuse.
   */
  std::vector<Change> settleAtStart(const std::vector<bool>& accepted, Timestamp now);

  /**
   * Decides for a lidar that first sent after the start, that has restarted, or whose clock has stepped by `step`
   * with this packet. Does nothing for one that is settled.
   */
  std::optional<Change> settle(LidarIndex, std::optional<Duration> step, Timestamp now);

  /**
   * Lets an aligned clock follow the others, and returns by how much a common clock has drifted against them if a
   * person should know.
   */
  std::optional<Duration> watch(LidarIndex, Timestamp now);

  /** Of the lidar whose packets are quickest; none if none sends and is used. */
  std::optional<Duration> leastDelay() const;

 private:
  std::vector<std::optional<Duration>> configuredDelays(const std::vector<bool>& accepted) const;
  std::optional<LidarIndex> reference(LidarIndex other_than, Timestamp now) const;
  std::optional<Duration> commonDelay(LidarIndex, Timestamp now) const;

  std::vector<std::string> names_;
  std::vector<LidarClock> clocks_;
  OtherClock other_clock_;
};
}  // namespace scanloom
