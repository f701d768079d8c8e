/** Pose and clock of the IMU on the body by what a lidar saw of the drive. */
#pragma once
#include "calibration/internal/ImuMountProblem.h"
#include "calibration/internal/MountCovariance.h"

#include <optional>
#include <vector>

namespace scanloom
{
enum class ImuMountOutcome
{
  Estimated,
  Open,             // but for some directions, which keep the given values
  TurnedTooLittle,  // stood still, or turned about one axis only: the rotations of lidar and IMU do not tell the pose
  Contradicted,     // no pose makes the IMU measure this drive: another drive's, other units, left-handed axes
};

/** The mount is the given one, unless Estimated or Open; its clock offset is how late the IMU's stamps are. */
struct ImuMountEstimate : ToldMount
{
  ImuMountOutcome outcome = ImuMountOutcome::TurnedTooLittle;
  Mount told;  // the same with the open directions as the drive tells them: better than a pose 20 deg off
  std::size_t poses = 0;
  PoseNoise residual{0, 0};  // root mean square of the lidar's poses to the IMU's
  double misfit = 0;         // of the IMU's motions, in their standard deviations
};

/** Estimated or Open: the mount is more than the given one. */
bool hasNumbers(const ImuMountEstimate&);

/**
 * Rotation and clock from nothing, by comparing the lidar's turns with the gyroscope's; the position as given. None if
 * the turns do not tell it to 5 deg, or differ in size. The poses must not depend on the IMU.
 */
std::optional<Mount> imuMountByTurns(const Trajectory& local_T_body, const std::vector<ImuSample>&, const Mount& given);

/** Where imuMountByTurns() told nothing: whether for want of turns of the body, or because the IMU's are others. */
ImuMountEstimate withoutImuMount(const Trajectory& local_T_body, const Mount& given);

/**
 * All at once (solveImuMount) from `start`, by at most 1500 poses. `given` is what is known without the drive: open
 * directions keep it. The poses' scans should have been deskewed with the start's IMU.
 */
ImuMountEstimate estimateImuMount(const Trajectory& local_T_body, const std::vector<ImuSample>&, const Mount& given,
                                  const Mount& start, const ImuNoise&);
}  // namespace scanloom
