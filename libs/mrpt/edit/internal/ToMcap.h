#pragma once
#include "base/core/StampedPose.h"
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"

#include <filesystem>
#include <optional>

namespace scanloom
{
/**
 * Writes an MCAP file that viewers of ROS 2 play: each label of clouds as a PointCloud2 in the frame base_link (x, y, z
 * in m, intensity, t in ns after the header's stamp, ring, lidar: its number in the rawlog), those of one lidar
 * (splitLidars) in the frame of its name, each IMU as Imu in a frame
 * of its label, base_link in the frame map as tf, and all of it as a Path. The poses are those of `trajectory`; if it
 * is empty, those in the rawlog (CObservationRobotPose, CObservationOdometry). Slices are left out. Throws
 * std::runtime_error if the file cannot be written.
 */
RawlogOperation toMcap(const std::filesystem::path& file, Trajectory trajectory, const std::optional<RecordingHeader>&);
}  // namespace scanloom
