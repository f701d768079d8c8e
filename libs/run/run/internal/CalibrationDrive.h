/** A drive as calibration needs it: the path by one lidar, and the scans of all apart. */
#pragma once
#include "base/core/StampedPose.h"
#include "calibration/Extrinsics.h"
#include "calibration/RotationByImus.h"
#include "run/run/SlamRun.h"

namespace scanloom
{
struct CalibrationDrive
{
  Trajectory trajectory;  // of the body by the reference lidar and the IMU, at the IMU's stamps; without an IMU as
                          // `registered`
  Trajectory registered;  // of the body in the local map, by registration alone: at the ends of scans; without an IMU,
                          // at their middles
  std::vector<ImuSample> imu;                 // of the body's IMU, as it stamped them
  std::vector<LidarImu> lidar_imus;           // by sensor id; without samples where a lidar has none
  std::vector<std::vector<LidarScan>> scans;  // by sensor id
  SlamRunResult run;
};

/**
 * Localises with the lidar `reference` (a sensor id) alone, so that the path does not depend on the poses of the
 * others, and with the body's IMU, if there is one, where `body_imu` says, else that of the reference. Throws as
 * runSlam does.
 */
CalibrationDrive driveForCalibration(SensorInput&, std::size_t reference, const SlamSettings&,
                                     const std::optional<Extrinsics>& body_imu, const KeepGoing&, const Warn&);

/** For lidars without given poses (calibration/ScansOfDrive.h). */
CalibrationDrive withoutOwnParts(CalibrationDrive, const std::vector<MountedLidar>&);

/** A few bad poses do no harm, but a path with breaks fits nothing. */
bool isPath(const CalibrationDrive&);
}  // namespace scanloom
