/** Where the body is from one state to the next, as the IMU saw it. */
#pragma once
#include "batching/Scan.h"
#include "core/ImuSample.h"
#include "core/StampedPose.h"
#include "imu/NavState.h"

#include <vector>

namespace scanloom
{
/**
 * The body in the map at each column of a scan, in their order. Whole turns come lidar by lidar, not in order of time,
 * and begin before the scan before them has ended: columns before `from` lie on the `way_to` it, never beyond its ends,
 * or at `from` if that is empty.
 */
std::vector<Rigid> bodyAtColumns(const Scan&, const NavState& from, const std::vector<ImuSample>&,
                                 const Rigid& imu_T_body, const Trajectory& way_to);

/** At every sample after `from`; what does not close with `to` is spread over the time between. */
Trajectory posesBetween(const NavState& from, const NavState& to, const std::vector<ImuSample>&,
                        const Rigid& imu_T_body);
}  // namespace scanloom
