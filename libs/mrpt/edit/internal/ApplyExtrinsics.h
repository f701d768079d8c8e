#pragma once
#include "base/core/Rigid.h"
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"

#include <filesystem>
#include <map>
#include <string>

namespace scanloom
{
/** body_T_sensor by the lidar's name; the body's IMU is "imu". */
using SensorPoses = std::map<std::string, Rigid>;

/**
 * Reads lines `T_body_<name> ...` (readExtrinsics), or a configuration (.ini) with a section of lidars: the poses that
 * it gives and those of its file of extrinsics. Throws what their readers throw.
 */
SensorPoses readSensorPoses(const std::filesystem::path&);

/**
 * Gives sensors another pose on the body: moves each lidar's points and IMU from the pose in the header to the new one
 * and changes the header. Lidars without a new pose stay. Clouds come out in the body frame. Throws UsageError if no
 * sensor of the rawlog is among the poses.
 */
RawlogOperation applyExtrinsics(const SensorPoses&, const RecordingHeader&);
}  // namespace scanloom
