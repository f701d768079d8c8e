/** The rotation group: exponential, logarithm and right Jacobian (Forster 2017, eq. (3) to (9)); radians. */
#pragma once
#include <Eigen/Geometry>

namespace scanloom
{
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/** Rotation by |v| rad about v; also exact for |v| -> 0. */
Eigen::Quaterniond expSo3(const Eigen::Vector3d& v);

/** The smallest rotation that turns the direction `from` into the direction `to`; neither needs to be of unit length.
 */
Eigen::Quaterniond rotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/** The rotation vector of a unit quaternion, inverse of expSo3; |result| <= pi. */
Eigen::Vector3d logSo3(const Eigen::Quaterniond& q);

/** exp(v + dv) ~ exp(v) exp(Jr(v) dv), Forster 2017 eq. (8). */
Eigen::Matrix3d rightJacobianSo3(const Eigen::Vector3d& v);

/** Inverse of rightJacobianSo3; log(exp(v) exp(dv)) ~ v + Jr^-1(v) dv, eq. (9). Valid for |v| < 2 pi. */
Eigen::Matrix3d rightJacobianInverseSo3(const Eigen::Vector3d& v);
}  // namespace scanloom
