/** All of a drive at once: states of the IMU at the lidar's poses, and where the IMU is on the body. */
#pragma once
#include "base/core/StampedPose.h"
#include "calibration/Extrinsics.h"
#include "calibration/internal/ExtrinsicsEquations.h"
#include "estimation/imu/ImuBuffer.h"
#include "estimation/imu/Preintegration.h"

#include <vector>

namespace scanloom
{
/** How far a pose by the lidar may be from the IMU's, each axis: m and rad. */
struct PoseNoise
{
  double position, rotation;
};

/** What estimates the extrinsics, and how the drive resists its changes. */
struct ImuExtrinsicsSolution
{
  Extrinsics extrinsics;
  Vector7d step = Vector7d::Zero();  // of the last round: position and rotation in the IMU's axes, clock
  PoseNoise residual{0, 0};          // root mean square of what is left
  double motion_misfit = 0;          // root mean square of the motions' residuals, in their standard deviations
  /** Of the extrinsics in the IMU's axes and the clock, when all else takes its best value: in metres. */
  Matrix7d information = Matrix7d::Zero();
  std::vector<Vector7d> gradients;  // by lidar pose, what it and the motion to the next pull at the extrinsics
};

/**
 * Poses of the body by a lidar, in its own map that need not be level, joined by preintegrated motions of the IMU
 * (Forster 2017). Unknown: pose, velocity and biases of the IMU at every pose, the plumb line, and the extrinsics,
 * whose clock offset is how late the IMU's stamps are. On Ceres, from `start`; gravity is 9.80665 m/s2. The samples
 * must cover the poses.
 */
ImuExtrinsicsSolution solveImuExtrinsics(const Trajectory& local_T_body, const std::vector<ImuSample>&,
                                         const Extrinsics& start, const ImuNoise&, const PoseNoise&);
}  // namespace scanloom
