/** One step between two neighbouring IMU samples: the only place where readings are integrated. */
#pragma once
#include "core/ImuSample.h"
#include "imu/NavState.h"

#include <vector>

namespace scanloom
{
/** Motion since a first instant, in the IMU's frame of that instant and without gravity: Forster 2017, eq. (33). */
struct ImuDelta
{
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/** Throws std::invalid_argument that names the stamp which is not after the one before it. */
void requireIncreasingStamps(const std::vector<ImuSample>&);

/** The readings on the straight line between two samples; `stamp` lies between theirs. */
ImuSample interpolate(const ImuSample& first, const ImuSample& second, Timestamp stamp);

/**
 * Carries `start`, valid at first.stamp, on to second.stamp: the mean rate turns, and the specific force, turned into
 * the first instant's frame, runs linearly between the two samples. Second order in the step: what lies beyond is
 * smaller than the error of interpolating the readings linearly.
 */
ImuDelta advance(const ImuDelta& start, const ImuSample& first, const ImuSample& second, const ImuBias&);

/** The state at `delta`'s end if it was `from` at its first instant: gravity comes back in. Keeps from's bias. */
NavState compose(const NavState& from, const ImuDelta& delta, Timestamp end);
}  // namespace scanloom
