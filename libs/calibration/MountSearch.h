/** A start for estimateMount() from a pose that may be far off. */
#pragma once
#include "calibration/internal/Stations.h"

#include <vector>

namespace scanloom
{
enum class PoseGiven
{
  Within20Degrees,  // and half a metre
  No,               // somewhere near the reference lidar
};

/**
 * Roll, pitch and height such that both lidars see the ground in the same plane; then headings, 10 deg apart within 20
 * deg or 30 deg apart all around, as they are and refined with cells of 4 m and 2 m at eight stations. The one with
 * most points where the reference saw something.
 */
Mount findStart(const std::vector<Station>&, const Mount& given, PoseGiven, const std::vector<LidarScan>& of_lidar,
                const std::vector<LidarScan>& of_reference, const Rigid& body_T_reference, const Trajectory&);
}  // namespace scanloom
