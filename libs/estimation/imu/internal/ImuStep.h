/** Integration of the readings over one step between two neighbouring IMU samples. */
#pragma once
#include "base/core/ImuSample.h"
#include "estimation/imu/NavState.h"

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

/** Throws std::invalid_argument with the first stamp that is not after the one before it. */
void requireIncreasingStamps(const std::vector<ImuSample>&);

/** Linear; `stamp` is between those of the samples. Refused readings between them lie on both sides of the new one. */
ImuSample interpolate(const ImuSample& first, const ImuSample& second, Timestamp stamp);

/**
 * From `start` at first.stamp to second.stamp, with the mean rate and with a specific force that is linear in time in
 * the first instant's frame. Accurate to second order in the step; higher orders are smaller than the error of
 * interpolating the readings linearly.
 */
ImuDelta advance(const ImuDelta& start, const ImuSample& first, const ImuSample& second, const ImuBias&);

/** The state after `delta` from `from`, with gravity. Keeps from's bias. */
NavState compose(const NavState& from, const ImuDelta& delta, Timestamp end);
}  // namespace scanloom
