/** Time and memory that an occupancy map will need. */
#pragma once
#include "base/core/StampedPose.h"
#include "input/rig/RecordingHeader.h"
#include "mrpt/maps/OctoMapExport.h"

#include <vector>

namespace scanloom
{
struct DriveSize
{
  std::vector<double> rays;  // per keyframe, of each lidar
  double keyframes = 0;
  double length = 0;  // m of path
};

class SimpleMapReader;

DriveSize driveSizeOf(const SimpleMapReader&);

/** Of keyframes at this distance (m of travel; 0: every pose of the path), each with every column and beam. */
DriveSize driveSizeOf(const Trajectory&, double keyframe_distance, const RecordingHeader&);

struct OctoMapCost
{
  double seconds = 0;  // of one core
  double bytes = 0;
};

/**
 * An upper bound for forests, at most three times too large: how much space the lidars see depends on what stands
 * there.
 */
OctoMapCost estimateOf(const OctoMapOptions&, const DriveSize&);
}  // namespace scanloom
