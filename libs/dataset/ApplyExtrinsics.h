/** A rawlog as if its sensors had been mounted, or calibrated, otherwise. */
#pragma once
#include "core/Rigid.h"
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/RecordingHeader.h"

#include <filesystem>
#include <map>
#include <string>

namespace scanloom
{
/** body_T_sensor by the lidar's name, and of the body's IMU as "imu". */
using SensorPoses = std::map<std::string, Rigid>;

/**
 * Of lines `T_body_<name> ...` (readExtrinsics), or of a configuration (.ini) with a section of lidars: their poses, or
 * those of its file of extrinsics. Throws what their readers throw.
 */
SensorPoses readSensorPoses(const std::filesystem::path&);

/**
 * Moves each point from where its lidar was said to be to where it is, and with it the lidar's IMU; lidars without a
 * new pose stay. Clouds come in the body frame. Throws UsageError if no sensor of the rawlog is among the poses.
 */
RawlogOperation applyExtrinsics(const SensorPoses&, const RecordingHeader&);
}  // namespace scanloom
