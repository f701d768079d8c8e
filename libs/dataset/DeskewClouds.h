#pragma once
#include "batching/Scan.h"
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/RecordingHeader.h"
#include "output/Trajectory.h"

#include <mrpt/obs/CObservationPointCloud.h>

#include <optional>

namespace scanloom
{
/** With the time of each column; throws std::invalid_argument for clouds without t. */
Scan timedScanOf(const mrpt::obs::CObservationPointCloud&, const std::optional<RecordingHeader>&);

/** The cloud with its points elsewhere in the body frame; all fields stay. */
ObservationPtr withPositions(const mrpt::obs::CObservationPointCloud&, const PointCloud&);

/**
 * The scan of a cloud as it would have been seen at its start, in the body frame, by the trajectory's motion; nothing
 * where the trajectory does not reach. Throws std::invalid_argument for clouds without t.
 */
std::optional<PointCloud> deskewed(const mrpt::obs::CObservationPointCloud&, const Trajectory&,
                                   const std::optional<RecordingHeader>&);

/**
 * Clouds deskewed to their stamp; all fields stay, t too. Clouds where the trajectory does not reach go; at the end of
 * input throws std::runtime_error if all did. Throws std::invalid_argument for a trajectory without poses.
 */
RawlogOperation deskewClouds(const Trajectory&, const std::optional<RecordingHeader>&);
}  // namespace scanloom
