/** Removes points by their position. */
#pragma once
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"

#include <Eigen/Geometry>

#include <limits>
#include <optional>

namespace scanloom
{
/** Removes the points inside the box or on its faces, from clouds of any class and with any sensorPose. */
RawlogOperation cropOut(const Eigen::AlignedBox3f& box_in_body);

struct RangeLimits
{
  double least = 0, most = std::numeric_limits<double>::infinity();  // m; points at a limit are kept
};

/**
 * Removes points nearer to or farther from the lidar that measured them. Distances start at the cloud's sensorPose if
 * there is no header, and at the lidar if the header has one lidar and the cloud no sensor_id.
 */
RawlogOperation limitRanges(const RangeLimits&, const std::optional<RecordingHeader>&);
}  // namespace scanloom
