/** A pose by a lidar, where the IMU's pose on the body, its clock and the plumb line are unknown. */
#pragma once
#include "base/core/Rigid.h"

#include <ceres/cost_function.h>

#include <memory>

namespace scanloom
{
/** local_T_body by registration, at the instant of a state by stamps; the local map need not be level. */
struct SeenPose
{
  Rigid local_T_body;
  Matrix6d root;  // of the information, of steps of boxPlus in the body's axes
  Eigen::Quaterniond map_R_local;
  Eigen::Vector3d turn_rate;  // rad/s, of the IMU in its own axes, by which the state moves to another instant
};

/**
 * Six whitened residuals: translation, and rotation by twice the quaternion's vector part, which is the angle where it
 * is small. Blocks: pose and motion of the state (StateBlocks), body_T_imu (PoseManifold), a small tilt of the local
 * map about x and y (rad, 2), its drift there (m, rad, 6), a small delay of the IMU's stamps (s, 1).
 */
std::unique_ptr<ceres::CostFunction> imuExtrinsicsFactor(const SeenPose&);
}  // namespace scanloom
