#include "run/run/ImuCalibration.h"

#include "base/core/Angle.h"

namespace scanloom
{
namespace
{
/** A tenth of the start's error is left: by then less than the standard deviation. */
bool isNear(const Extrinsics& a, const Extrinsics& b)
{
  constexpr double kNear = 0.05, kTurn = 0.3 * kDegree, kClock = 2e-3;  // m, rad, s
  return (a.body_T_sensor.translation - b.body_T_sensor.translation).norm() < kNear &&
         a.body_T_sensor.rotation.angularDistance(b.body_T_sensor.rotation) < kTurn &&
         std::abs(a.clock_offset - b.clock_offset) < kClock;
}

SlamSettings withImu(const SlamSettings& settings)
{
  SlamSettings in_use = settings;
  in_use.slam.imu = "body";
  return in_use;
}

SlamSettings withoutImu(const SlamSettings& settings)
{
  SlamSettings in_use = settings;
  in_use.slam.imu = "none";
  return in_use;
}

/**
 * For deskewing, and where the lidar tells nothing: the prediction of a good IMU outvotes the lidar, so registrations
 * would confirm its pose. With three times this noise a dense stand was registered no better than without an IMU.
 */
SlamSettings withDistrustedImu(const SlamSettings& settings)
{
  SlamSettings in_use = withImu(settings);
  in_use.imu.gyro_noise_deg = 1;
  in_use.imu.accel_noise = 1;
  return in_use;
}
}  // namespace

ImuCalibration calibrateImu(const OpenInput& open, std::size_t reference, const SlamSettings& settings,
                            const Extrinsics& given, const KeepGoing& keepGoing, const Warn& warn)
{
  constexpr int kMostDrives = 3;
  ImuCalibration result;
  std::vector<std::string> warnings;  // those of the last drive count
  const auto drive = [&](const SlamSettings& in_use, const std::optional<Extrinsics>& imu)
  {
    warnings.clear();
    result.drive = {};  // its scans are large
    result.drive = driveForCalibration(*open(), reference, in_use, imu, keepGoing,
                                       [&](const std::string& warning) { warnings.push_back(warning); });
  };

  drive(withoutImu(settings), std::nullopt);
  std::optional<Extrinsics> start = imuExtrinsicsByTurns(result.drive.registered, result.drive.imu, given);
  result.imu = withoutImuExtrinsics(result.drive.registered, given);
  // In a dense stand the lidar alone tells the turns badly. By the pose as given, a wrong IMU still fits nothing.
  if (!start && result.imu.outcome == ImuExtrinsicsOutcome::Contradicted) start = given;
  for (int i = 0; start && i < kMostDrives; ++i)
  {
    drive(withDistrustedImu(settings), start);
    result.imu = estimateImuExtrinsics(result.drive.registered, result.drive.imu, given, *start, settings.imu);
    if (!hasNumbers(result.imu) || isNear(result.imu.by_drive, *start)) break;
    start = result.imu.by_drive;
  }
  // Without a pose the lidars go by the drive before: by the given one, 3 deg off, a drive on flat ground was lost.
  if (hasNumbers(result.imu)) drive(withImu(settings), result.imu.by_drive);
  for (const std::string& warning : warnings) warn(warning);
  return result;
}
}  // namespace scanloom
