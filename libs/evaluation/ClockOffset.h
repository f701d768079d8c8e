/** How much the clocks of a reference and an estimate differ, from their positions alone. */
#pragma once
#include "evaluation/PositionTrack.h"

#include <optional>

namespace scanloom
{
/**
 * The time by which the reference's stamps are too late, within 2 s either way: with it taken off, the positions agree
 * best after yaw and translation are fitted to all of them. Nothing if the machine does not change its velocity enough
 * to tell (a second would show as less than 0.05 m), if the best is at the end of the range, or if they share no time.
 */
std::optional<Duration> clockOffset(const Trajectory& estimate, const Eigen::Vector3d& body_p_point,
                                    const PositionTrack& reference);

/** With stamps earlier by so much. */
PositionTrack earlier(PositionTrack, Duration);
}  // namespace scanloom
