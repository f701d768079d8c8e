#pragma once
#include "base/core/Rigid.h"
#include "base/core/Time.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** Pose of the body at an instant. */
struct StampedPose
{
  Timestamp stamp;
  Rigid map_T_body;
};

/** Stamps increase strictly. */
using Trajectory = std::vector<StampedPose>;

/**
 * The pose at `stamp`, interpolated between its neighbours: translation linearly, rotation by slerp. Nothing before the
 * first or after the last pose, or if the neighbours are more than `widest` apart.
 */
std::optional<Rigid> poseAt(const Trajectory&, Timestamp stamp, Duration widest = Duration::max());
}  // namespace scanloom
