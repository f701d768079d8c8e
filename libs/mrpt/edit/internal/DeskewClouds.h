#pragma once
#include "base/core/StampedPose.h"
#include "input/batching/Scan.h"
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"

#include <mrpt/obs/CObservationPointCloud.h>

#include <optional>

namespace scanloom
{
/** The cloud as a scan with the time of each column; throws std::invalid_argument for clouds without t. */
Scan timedScanOf(const mrpt::obs::CObservationPointCloud&, const std::optional<RecordingHeader>&);

/**
 * The points of a cloud in the body frame at its stamp, deskewed by the trajectory; none if the trajectory does not
 * cover the scan. Throws std::invalid_argument for clouds without t.
 */
std::optional<PointCloud> deskewed(const mrpt::obs::CObservationPointCloud&, const Trajectory&,
                                   const std::optional<RecordingHeader>&);

/**
 * Deskews clouds to their stamp; all fields stay, t too. Clouds that the trajectory does not cover are removed; throws
 * std::runtime_error at the end of input if all were. Throws std::invalid_argument for a trajectory without poses.
 */
RawlogOperation deskewClouds(const Trajectory&, const std::optional<RecordingHeader>&);
}  // namespace scanloom
