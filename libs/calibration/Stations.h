/** Places of a drive at which one lidar is compared with what the reference lidar saw there and near there. */
#pragma once
#include "calibration/Mount.h"

#include <vector>

namespace scanloom
{
struct Station
{
  Timestamp at;
  const LidarScan* scan;        // of the lidar that is calibrated
  std::vector<View> reference;  // of the reference lidar, in the body's frame at the instant
  Vector6d twist;               // m/s and rad/s, of the body in its own frame
};

/**
 * At most 60, evenly chosen, at least 0.7 m or 10 deg apart: a machine at rest gives a single one. The reference's
 * views are 1 m or 10 deg apart, from up to `reach` (m) around: what one lidar sees first and another later is compared
 * as well. The farther, the more the error of the path counts.
 */
std::vector<Station> stationsOf(const std::vector<LidarScan>& of_lidar, const std::vector<LidarScan>& of_reference,
                                const Mount& reference, const Trajectory&, double reach);
}  // namespace scanloom
