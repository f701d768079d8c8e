/** A point cloud of another program as a scan. */
#pragma once
#include "base/core/MountedLidar.h"
#include "input/batching/Scan.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace scanloom
{
/** Arrays of equal length; those that are empty are not known. */
struct CloudArrays
{
  std::vector<Eigen::Vector3f> xyz;  // m, in the body frame at each point's own time
  std::vector<std::int64_t> t;       // ns after the stamp; empty: all points are of the stamp
  std::vector<std::int64_t> lidar, ring, intensity;
};

/**
 * The scan [stamp, stamp + period), or [stamp - period, stamp) where points have no times. Points that are not finite
 * are left out. `period` is by default up to the last point, and 0.1 s without times. Throws UsageError with what is
 * wrong with the arrays.
 */
Scan cloudScan(Timestamp stamp, std::optional<Duration> period, const CloudArrays&,
               const std::vector<MountedLidar>& lidars);
}  // namespace scanloom
