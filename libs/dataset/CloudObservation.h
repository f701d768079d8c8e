/** What the operations on rawlogs ask of an observation that holds a cloud. */
#pragma once
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/CGenericPointsMap.h"
#include "mrpt_bridge/RecordingHeader.h"

#include <mrpt/obs/CObservationPointCloud.h>
#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** Null for what is no cloud. One that is stored in a file of its own is loaded, or std::invalid_argument thrown. */
mrpt::obs::CObservationPointCloud::Ptr cloudIn(const ObservationPtr&);

/** With fields; throws std::invalid_argument, saying how to mend it, for a cloud of another class. */
const mrpt::maps::CGenericPointsMap& genericCloudOf(const mrpt::obs::CObservationPointCloud&);

/** By point; throws std::invalid_argument if the cloud has none, or one that is no lidar of the header. */
std::vector<std::uint8_t> sensorIdsOf(const mrpt::obs::CObservationPointCloud&, const RecordingHeader&);

/** Whatever the sensorPose; in m. */
std::vector<Eigen::Vector3f> positionsInBody(const mrpt::obs::CObservationPointCloud&);

/** The same label, stamp and pose with other points: stored in the rawlog itself, wherever they were before. */
mrpt::obs::CObservationPointCloud::Ptr withPoints(const mrpt::obs::CObservationPointCloud&,
                                                  mrpt::maps::CPointsMap::Ptr);

/** For operations on lidars; throws std::invalid_argument, saying how to mend it, if there is no header. */
const RecordingHeader& required(const std::optional<RecordingHeader>&);

/** Of the file's first object. Throws std::runtime_error if it can't be opened. */
std::optional<RecordingHeader> headerOf(const std::filesystem::path&);

/** The comment with another header in it. */
ObservationPtr withHeader(const mrpt::obs::CObservation& comment, const RecordingHeader&);

/** The place in the header; throws UsageError with the nearest name. */
std::size_t lidarNamed(const std::string& name, const RecordingHeader&);

/** `lidar` and `left` make `lidar_left`; a slice stays one: `lidar_left_slice`. */
std::string labelOfPart(const std::string& whole, const std::string& lidar);

struct LidarPart
{
  std::string whole;  // label of the cloud of all lidars
  std::size_t lidar;  // place in the header
};
/** The reverse; nothing if the label is that of no lidar's part. */
std::optional<LidarPart> partOf(const std::string& label, const RecordingHeader&);
}  // namespace scanloom
