/** Pose and clock of the IMU on the body by what a lidar saw of the drive. */
#pragma once
#include "calibration/internal/ExtrinsicsCovariance.h"
#include "calibration/internal/ImuExtrinsicsProblem.h"

#include <optional>
#include <vector>

namespace scanloom
{
enum class ImuExtrinsicsOutcome
{
  Estimated,
  Open,             // but for some directions, which keep the given values
  TurnedTooLittle,  // stood still, or turned about one axis only: the rotations of lidar and IMU do not tell the pose
  Contradicted,     // no pose makes the IMU measure this drive: another drive's, other units, left-handed axes
};

/** The extrinsics are those given, unless Estimated or Open; its clock offset is how late the IMU's stamps are. */
struct ImuExtrinsicsEstimate : ObservableExtrinsics
{
  ImuExtrinsicsOutcome outcome = ImuExtrinsicsOutcome::TurnedTooLittle;
  Extrinsics by_drive;  // the same with the open directions as the drive shows them: better than a pose 20 deg off
  std::size_t poses = 0;
  PoseNoise residual{0, 0};  // root mean square of the lidar's poses to the IMU's
  double misfit = 0;         // of the IMU's motions, in their standard deviations
};

/** Estimated or Open: the extrinsics are more than those given. */
bool hasNumbers(const ImuExtrinsicsEstimate&);

/**
 * Rotation and clock from nothing, by comparing the lidar's turns with the gyroscope's; the position as given. None if
 * the turns do not tell it to 5 deg, or differ in size. The poses must not depend on the IMU.
 */
std::optional<Extrinsics> imuExtrinsicsByTurns(const Trajectory& local_T_body, const std::vector<ImuSample>&,
                                               const Extrinsics& given);

/** Where imuExtrinsicsByTurns() gives nothing: whether for want of turns of the body, or because the IMU's are others.
 */
ImuExtrinsicsEstimate withoutImuExtrinsics(const Trajectory& local_T_body, const Extrinsics& given);

/**
 * All at once (solveImuExtrinsics) from `start`, by at most 1500 poses. `given` is what is known without the drive:
 * open directions keep it. The poses' scans should have been deskewed with the start's IMU.
 */
ImuExtrinsicsEstimate estimateImuExtrinsics(const Trajectory& local_T_body, const std::vector<ImuSample>&,
                                            const Extrinsics& given, const Extrinsics& start, const ImuNoise&);
}  // namespace scanloom
