/** Body poses between two states, by the IMU. */
#pragma once
#include "base/core/ImuSample.h"
#include "base/core/StampedPose.h"
#include "estimation/imu/NavState.h"
#include "input/batching/Scan.h"

#include <vector>

namespace scanloom
{
/**
 * map_T_body at each column of a scan, in the order of the columns. Columns after `from` are predicted by the samples.
 * Whole turns come lidar by lidar and begin before the previous scan has ended, so columns may be older than `from`:
 * their poses are interpolated in `before`, body poses up to `from`, and held at its ends; they are those of `from` if
 * `before` is empty.
 */
std::vector<Rigid> bodyAtColumns(const Scan&, const NavState& from, const std::vector<ImuSample>&,
                                 const Rigid& imu_T_body, const Trajectory& before);

/** map_T_body at every sample after `from`; the error of the prediction at `to` is spread evenly over the time. */
Trajectory posesBetween(const NavState& from, const NavState& to, const std::vector<ImuSample>&,
                        const Rigid& imu_T_body);
}  // namespace scanloom
