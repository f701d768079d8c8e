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
 * map_T_body at each column of a scan, in the order of the columns, as the samples predict it. A scan of a rawlog may
 * begin before the previous one has ended: a column older than `from` has the pose of `from`.
 */
std::vector<Rigid> bodyAtColumns(const Scan&, const NavState& from, const std::vector<ImuSample>&,
                                 const Rigid& imu_T_body);

/** map_T_body at every sample after `from`; the error of the prediction at `to` is spread evenly over the time. */
Trajectory posesBetween(const NavState& from, const NavState& to, const std::vector<ImuSample>&,
                        const Rigid& imu_T_body);
}  // namespace scanloom
