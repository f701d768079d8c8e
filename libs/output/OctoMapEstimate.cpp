#include "output/OctoMapEstimate.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
// Measured with two OS0-128 in simulated stands (tests/benchmarks/output_benchmark.cpp).
constexpr double kSeenHeight = 0.6;          // of max_range: rays end at the ground and leave the stand above
constexpr double kInnerNodes = 8.0 / 7;      // per leaf
constexpr double kBytesPerNode = 56;         // with its share of the array of children
constexpr double kSecondsPerVoxel = 2.5e-7;  // that a lidar's rays touch; with writing the files

double diskVolume(double range) { return M_PI * range * range * kSeenHeight * range; }
}  // namespace

OctoMapCost estimateOf(const OctoMapOptions& options, const DriveSize& drive)
{
  const double voxel = std::pow(options.resolution, 3);
  double touched = 0;  // per keyframe
  for (const double rays : drive.rays)
    touched += std::min(rays * options.max_range / options.resolution, 0.5 * diskVolume(options.max_range) / voxel);

  const double swept =
      diskVolume(options.max_range) + 2 * options.max_range * kSeenHeight * options.max_range * drive.length;
  const double leaves = std::min(swept / voxel, touched * drive.keyframes);
  return {touched * drive.keyframes * kSecondsPerVoxel, leaves * kInnerNodes * kBytesPerNode};
}
}  // namespace scanloom
