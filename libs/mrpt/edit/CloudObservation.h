/** What operations do with an observation that holds a cloud. */
#pragma once
#include "base/core/PointCloud.h"
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"
#include "mrpt/observations/CGenericPointsMap.h"

#include <mrpt/obs/CObservationPointCloud.h>
#include <Eigen/Core>

namespace scanloom
{
using CloudPtr = mrpt::obs::CObservationPointCloud::Ptr;

/**
 * The observation as a cloud; null if it is none. A cloud that is stored in a file of its own is loaded; throws
 * std::invalid_argument if that file is missing.
 */
CloudPtr cloudIn(const ObservationPtr&);

/** An operation on clouds: `change` returns what replaces a cloud; all other observations pass unchanged. */
RawlogOperation onClouds(std::function<Observations(const CloudPtr&)> change);

/** Removes points of clouds: `marks` returns one value per point, 0 for those to remove. */
RawlogOperation keepingPoints(std::function<std::vector<std::uint8_t>(const mrpt::obs::CObservationPointCloud&)> marks);

/** The points with their fields; throws std::invalid_argument with a remedy for a cloud of another class. */
const mrpt::maps::CGenericPointsMap& genericCloudOf(const mrpt::obs::CObservationPointCloud&);

/** Throws std::invalid_argument unless the cloud has the field t. */
void requireTimes(const mrpt::obs::CObservationPointCloud&);

/** The sensor_id of each point; throws std::invalid_argument if the cloud lacks the field or the header a lidar. */
std::vector<std::uint8_t> sensorIdsOf(const mrpt::obs::CObservationPointCloud&, const RecordingHeader&);

/** In m in the body frame, whatever the sensorPose. */
std::vector<Eigen::Vector3f> positionsInBody(const mrpt::obs::CObservationPointCloud&);

/** A cloud with the same label, stamp and pose and with other points, stored in the rawlog itself. */
CloudPtr withPoints(const mrpt::obs::CObservationPointCloud&, mrpt::maps::CPointsMap::Ptr);

/** A cloud with its points at these positions in the body frame; all fields stay. Changes the points of the given one.
 */
CloudPtr withPositions(const mrpt::obs::CObservationPointCloud&, const std::vector<Eigen::Vector3f>&);
CloudPtr withPositions(const mrpt::obs::CObservationPointCloud&, const PointCloud&);
}  // namespace scanloom
