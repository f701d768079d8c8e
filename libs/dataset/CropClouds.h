/** Points that go because of where they are. */
#pragma once
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/RecordingHeader.h"

#include <Eigen/Geometry>

#include <limits>
#include <optional>

namespace scanloom
{
/** Removes the points inside, edges included: of clouds of any class, whatever their sensorPose. */
RawlogOperation cropOut(const Eigen::AlignedBox3f& box_in_body);

struct RangeLimits
{
  double least = 0, most = std::numeric_limits<double>::infinity();  // m; both are kept
};

/**
 * Removes points nearer to or farther from the lidar that measured them. Without a header, or of clouds without
 * sensor_id where it names one lidar, there is one origin: the lidar's, or else the cloud's sensorPose.
 */
RawlogOperation limitRanges(const RangeLimits&, const std::optional<RecordingHeader>&);
}  // namespace scanloom
