#pragma once
#include "base/core/Rigid.h"
#include "base/core/Time.h"

namespace scanloom
{
struct ImuBias
{
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();   // rad/s
  Eigen::Vector3d accel = Eigen::Vector3d::Zero();  // m/s2
};

/** The IMU at one instant. The map frame's z axis is up: gravity is (0, 0, -kGravity) there. */
struct NavState
{
  Timestamp stamp;
  Rigid map_T_imu;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, of the IMU, in the map frame
  ImuBias bias;

  bool allFinite() const;
};

inline constexpr double kGravity = 9.80665;  // m/s2, standard gravity (BIPM, 3rd CGPM 1901)
inline Eigen::Vector3d gravityInMap() { return {0, 0, -kGravity}; }

/** Tangent order of a state: translation and rotation (boxPlus of Rigid), velocity, gyro bias, accelerometer bias. */
using Vector15d = Eigen::Matrix<double, 15, 1>;
using Matrix15d = Eigen::Matrix<double, 15, 15>;

struct NavEstimate
{
  NavState state;
  Matrix15d covariance = Matrix15d::Zero();
};

NavState boxPlus(const NavState&, const Vector15d& step);

/** The step with boxPlus(from, step) = to; stamps are not looked at. */
Vector15d boxMinus(const NavState& to, const NavState& from);
}  // namespace scanloom
