#pragma once
#include "core/Rigid.h"
#include "core/Time.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** Where the body was at an instant. */
struct StampedPose
{
  Timestamp stamp;
  Rigid map_T_body;
};

/** Stamps rise strictly. */
using Trajectory = std::vector<StampedPose>;

/**
 * Interpolated at `stamp` between its neighbours: position on the chord, rotation by slerp. Nothing before the first
 * and after the last pose, and between two that are more than `widest` apart.
 */
std::optional<Rigid> poseAt(const Trajectory&, Timestamp stamp, Duration widest = Duration::max());
}  // namespace scanloom
