/** The clock offset between a reference and an estimate, from their positions. */
#pragma once
#include "base/positions/PositionTrack.h"

#include <optional>

namespace scanloom
{
/**
 * By how much the stamps of the reference are late, between -2 s and 2 s: with the stamps corrected by it, the mean
 * squared distance of the positions is least, after an alignment with yaw on all of them. None if the velocity changes
 * so little that an offset of 1 s would cost less than 0.05 m, if the minimum is at an end of the range, or if the two
 * have no time in common.
 */
std::optional<Duration> clockOffset(const Trajectory& estimate, const Eigen::Vector3d& body_p_point,
                                    const PositionTrack& reference);

/** With all stamps moved back by the duration. */
PositionTrack earlier(PositionTrack, Duration);
}  // namespace scanloom
