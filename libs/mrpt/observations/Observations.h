/** Scans as MRPT's observations, and back. */
#pragma once
#include "input/batching/Scan.h"
#include "input/rawlogs/ImuObservation.h"
#include "input/rig/SensorInput.h"

#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <optional>
#include <string>

namespace scanloom
{
inline constexpr const char* kLidarLabel = "lidar";    // MOLA's default, so that its pipelines work without changes
inline constexpr const char* kSliceSuffix = "_slice";  // of the label of slices; a scan contains its slices again
inline constexpr const char* kHeaderLabel = "scanloom";

/** By its label. */
bool isSlice(const mrpt::obs::CObservation&);

enum class CloudClass
{
  CGenericPointsMap,  // all fields
  CPointsMapXYZI,     // x, y, z and intensity / 255 only: for stock tools of MRPT 2.x without the plugin
};

/** Throws std::invalid_argument, naming the key and the choices, for any other text. */
CloudClass cloudClassFromName(const std::string& name, const std::string& key = "cloud_class");

/**
 * The points in the body frame with identity sensorPose; the stamp is the scan's start, rounded down to MRPT's 100 ns.
 * Fields: `intensity` and `t` (float; t in s after the observation's stamp), `ring` and `column` (uint16; column is the
 * measurement id), `sensor_id` (uint8).
 */
mrpt::obs::CObservationPointCloud::Ptr toObservation(const Scan&, CloudClass = CloudClass::CGenericPointsMap,
                                                     const std::string& label = kLidarLabel);

/**
 * The scan of a cloud. Fields that the cloud does not have are 0. Points are in the body frame, whatever the
 * sensorPose. Columns are rebuilt from runs of equal (sensor_id, column).
 *
 * A rawlog does not contain columns without a valid return (columns_of does not count them), frame ids, range, signal
 * and near infrared (all 0), and whether the scan was complete (assumed). Stamps have errors of up to 104 ns, relative
 * to each other of up to 4 ns (t is a float). Without a rate of scans in the header, the period ends with the last
 * point. Throws std::invalid_argument if the cloud is stored in a file that does not exist.
 */
Scan fromObservation(const mrpt::obs::CObservationPointCloud&, const std::optional<RecordingHeader>&);

/** The same without the points that removeImpossible() removes, and without columns that lose all their points. */
Scan measuredScan(const mrpt::obs::CObservationPointCloud&, const std::optional<RecordingHeader>&);

/** The points of a map as they are, with the fields that it has. */
PointCloud pointsIn(const mrpt::maps::CPointsMap&);

/** Removes points that no lidar measures: not finite, or 100 km or more from the body along an axis. */
void removeImpossible(PointCloud& points_in_body);

/** A comment "mark: TEXT", at any place of a rawlog. Comments have no labels in a file that every MRPT reads. */
mrpt::obs::CObservationComment::Ptr toObservation(const EventMark&);

/** Nothing if the observation is no such comment. */
std::optional<EventMark> markIn(const mrpt::obs::CObservation&);

/** The first object of a rawlog. */
mrpt::obs::CObservationComment::Ptr toObservation(const RecordingHeader&, Timestamp);
}  // namespace scanloom
