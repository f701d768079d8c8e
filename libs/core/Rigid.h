/** A rigid transform. Named a_T_b it maps coordinates in b to a, and neighbours cancel: a_T_b * b_T_c = a_T_c. */
#pragma once
#include "core/So3.h"

#include <Eigen/Geometry>

namespace scanloom
{
struct Rigid
{
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // unit
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         // m

  static Rigid identity() { return {}; }

  /** From a 4x4 whose upper left block is a rotation to 1e-3 (rounded calibration files); throws std::invalid_argument.
   */
  static Rigid fromMatrix(const Eigen::Matrix4d&);

  /** Metres and radians, R = Rz(yaw) Ry(pitch) Rx(roll): MRPT's order. */
  static Rigid fromXyzYawPitchRoll(double x, double y, double z, double yaw, double pitch, double roll);

  Eigen::Matrix4d matrix() const;
  Eigen::Vector3d yawPitchRoll() const;  // rad
  Rigid inverse() const;

  /** Always normalised, so that long chains stay rigid. */
  Rigid operator*(const Rigid& other) const;
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return rotation * point + translation; }
};

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/** pose "plus" a step in its own frame: translation + R * step[0..2], R * exp(step[3..5]). The tangent order everywhere
 * is (translation, rotation). */
Rigid boxPlus(const Rigid& pose, const Vector6d& step);

/** The step with boxPlus(from, step) = to. */
Vector6d boxMinus(const Rigid& to, const Rigid& from);

/** Constant twist between two poses, share in [0, 1]: position on the chord, rotation by slerp. */
Rigid interpolate(const Rigid& from, const Rigid& to, double share);
}  // namespace scanloom
