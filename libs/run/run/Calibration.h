/** What `scanloom calibrate` found, and its files. */
#pragma once
#include "base/core/MountedLidar.h"
#include "calibration/ExtrinsicsEstimate.h"
#include "calibration/ExtrinsicsScene.h"
#include "calibration/ExtrinsicsSearch.h"
#include "calibration/ImuExtrinsicsEstimate.h"
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
  std::vector<ExtrinsicsEstimate> extrinsics;  // by lidar; the reference's is not used
  std::optional<ImuExtrinsicsEstimate> imu;    // none: the body has no IMU of its own, or it is not calibrated
};

struct LidarCalibration
{
  ExtrinsicsEstimate estimate;
  std::vector<ExtrinsicsScene> scenes;  // to look at; none where the machine stood still
};

/**
 * By what both saw near the same places. Lidars that look different ways see other sides of the same: by more of the
 * drive, with stems on their axes, and doubted by the distance of the two results.
 */
LidarCalibration calibrateLidar(std::size_t lidar, const std::vector<MountedLidar>&, std::size_t reference,
                                const CalibrationDrive&, Clock, PoseGiven);

/** Whether the drive shows the extrinsics of all lidars, and of the IMU if there is one. */
bool trusted(const Calibration&);

/** The poses that every verb reads, as rig/Extrinsics.h does, each with a comment: as given, calibrated or not. */
std::string extrinsicsText(const Calibration&);

nlohmann::json toJson(const Calibration&);
}  // namespace scanloom
