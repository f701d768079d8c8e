/** What `scanloom calibrate` found, and its files. */
#pragma once
#include "base/core/MountedLidar.h"
#include "calibration/ImuMountEstimate.h"
#include "calibration/MountEstimate.h"
#include "calibration/MountScene.h"
#include "calibration/MountSearch.h"
#include "run/run/internal/CalibrationDrive.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct Calibration
{
  std::vector<MountedLidar> lidars;  // as given
  std::size_t reference = 0;
  std::vector<MountEstimate> mounts;    // by lidar; the reference's is not used
  std::optional<ImuMountEstimate> imu;  // none: the body has no IMU of its own, or it is not calibrated
};

struct LidarCalibration
{
  MountEstimate estimate;
  std::vector<MountScene> scenes;  // to look at; none where the machine stood still
};

/**
 * By what both saw near the same places. Lidars that look different ways see other sides of the same: by more of the
 * drive, with stems on their axes, and doubted by the distance of the two results.
 */
LidarCalibration calibrateLidar(std::size_t lidar, const std::vector<MountedLidar>&, std::size_t reference,
                                const CalibrationDrive&, Clock, PoseGiven);

/** Whether all lidars, and the IMU if there is one, are told. */
bool trusted(const Calibration&);

/** The poses that every verb reads, as rig/Extrinsics.h does, each with a comment: as given, calibrated or not. */
std::string extrinsicsText(const Calibration&);

nlohmann::json toJson(const Calibration&);
}  // namespace scanloom
