/** Rigid transforms. a_T_b maps coordinates in frame b to frame a; a_T_b * b_T_c = a_T_c. */
#pragma once
#include "base/core/So3.h"

#include <Eigen/Geometry>

namespace scanloom
{
struct Rigid
{
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // unit
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         // m

  static Rigid identity() { return {}; }

  /** The rotation may be off by 1e-3 (rounded calibration files). Throws std::invalid_argument if it is worse. */
  static Rigid fromMatrix(const Eigen::Matrix4d&);

  /** Metres and radians; R = Rz(yaw) Ry(pitch) Rx(roll), as in MRPT. */
  static Rigid fromXyzYawPitchRoll(double x, double y, double z, double yaw, double pitch, double roll);

  Eigen::Matrix4d matrix() const;
  Eigen::Vector3d yawPitchRoll() const;  // rad
  Rigid inverse() const;

  /** The rotation is normalised each time, so that long products stay rigid. */
  Rigid operator*(const Rigid& other) const;
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return rotation * point + translation; }
};

/** Unit vector along the map's z, which is up, in the body's frame. */
inline Eigen::Vector3d upInBody(const Rigid& map_T_body)
{
  return map_T_body.rotation.conjugate() * Eigen::Vector3d::UnitZ();
}

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/** The pose after a step in its own frame: translation + R * step[0..2], R * exp(step[3..5]). Tangent vectors are
 * (translation, rotation) everywhere. */
Rigid boxPlus(const Rigid& pose, const Vector6d& step);

/** The step with boxPlus(from, step) = to. */
Vector6d boxMinus(const Rigid& to, const Rigid& from);

/** Constant twist between two poses, share in [0, 1]: position on the chord, rotation by slerp. */
Rigid interpolate(const Rigid& from, const Rigid& to, double share);
}  // namespace scanloom
