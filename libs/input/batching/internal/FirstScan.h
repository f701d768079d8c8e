/** When the first scan starts: eq. (1) of the paper. */
#pragma once
#include "base/core/Time.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** A lidar before the first scan. */
struct LidarBeforeStart
{
  std::optional<Timestamp> first_stamp;  // t_0 of eq. (1), on the common clock; none if it has not sent or is left out
  Duration delay{0};                     // of its quickest packets, on the common clock; with first_stamp
  Duration patience{0};                  // how much later than its quickest packets a block may come
};

/**
 * t_0,max of eq. (1), the largest first stamp; none while it may still change. A silent lidar is waited for during one
 * period: no complete scan could be over sooner. One that starts later joins a later scan. Without `now` no more
 * packets will come.
 */
std::optional<Timestamp> latestFirstStamp(const std::vector<LidarBeforeStart>&, Duration period,
                                          std::optional<Timestamp> now);

/** t_init of eq. (1): the next multiple of the period, plus the phase, after t_0,max. */
Timestamp startAfter(Timestamp latest_first_stamp, Duration period, Duration phase);

/** As startAfter(), but a period earlier where the latest lidar begins less than `room` after that: the scan is whole.
 */
Timestamp startOfWholeScan(Timestamp latest_first_stamp, Duration period, Duration phase, Duration room);
}  // namespace scanloom
