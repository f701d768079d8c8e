/** A state as two parameter blocks of Ceres. */
#pragma once
#include "estimation/graph/internal/PoseManifold.h"
#include "estimation/imu/NavState.h"

namespace scanloom
{
using MotionBlock = Eigen::Matrix<double, 9, 1>;  // velocity, gyro bias, accelerometer bias

struct StateBlocks
{
  PoseBlock pose;      // moves by PoseManifold
  MotionBlock motion;  // moves by addition
};

inline constexpr int kStateSize = 15;  // of the tangent: boxPlus of NavState
inline constexpr int kPoseSize = 6;
inline constexpr int kMotionSize = 9;

StateBlocks blocksOf(const NavState&);
NavState stateOf(const double* pose, const double* motion, Timestamp);
}  // namespace scanloom
