/** What an occupancy map will take, before it is begun. */
#pragma once
#include "output/OctoMapExport.h"

#include <vector>

namespace scanloom
{
struct DriveSize
{
  std::vector<double> rays;  // of each lidar, per keyframe
  double keyframes = 0;
  double length = 0;  // m of path
};

struct OctoMapCost
{
  double seconds = 0;  // of one core
  double bytes = 0;
};

/**
 * An upper bound for stands of trees, within a factor of three: how much of the space around the path is seen depends
 * on what stands there.
 */
OctoMapCost estimateOf(const OctoMapOptions&, const DriveSize&);
}  // namespace scanloom
