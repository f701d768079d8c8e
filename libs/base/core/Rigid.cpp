#include "base/core/Rigid.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace scanloom
{
Rigid Rigid::fromMatrix(const Eigen::Matrix4d& m)
{
  const Eigen::Matrix3d r = m.topLeftCorner<3, 3>();
  const double error = (r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error < 1e-3) || r.determinant() < 0 || !m.allFinite() || !m.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1)))
    throw std::invalid_argument(fmt::format("not a rigid transform (rotation is {:.2g} off orthonormal)", error));
  return {Eigen::Quaterniond(r).normalized(), m.topRightCorner<3, 1>()};
}

Rigid Rigid::fromXyzYawPitchRoll(double x, double y, double z, double yaw, double pitch, double roll)
{
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return {Eigen::Quaterniond(AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) *
                             AngleAxisd(roll, Vector3d::UnitX())),
          {x, y, z}};
}

Eigen::Matrix4d Rigid::matrix() const
{
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = rotation.toRotationMatrix();
  m.topRightCorner<3, 1>() = translation;
  return m;
}

Eigen::Vector3d Rigid::yawPitchRoll() const
{
  const Eigen::Matrix3d r = rotation.toRotationMatrix();
  return {std::atan2(r(1, 0), r(0, 0)), std::atan2(-r(2, 0), std::hypot(r(2, 1), r(2, 2))),
          std::atan2(r(2, 1), r(2, 2))};
}

Rigid Rigid::inverse() const
{
  const Eigen::Quaterniond back = rotation.conjugate();
  return {back, -(back * translation)};
}

Rigid Rigid::operator*(const Rigid& other) const
{
  return {(rotation * other.rotation).normalized(), rotation * other.translation + translation};
}

Rigid boxPlus(const Rigid& pose, const Vector6d& step) { return pose * Rigid{expSo3(step.tail<3>()), step.head<3>()}; }

Vector6d boxMinus(const Rigid& to, const Rigid& from)
{
  const Rigid step = from.inverse() * to;
  Vector6d v;
  v << step.translation, logSo3(step.rotation);
  return v;
}

Rigid interpolate(const Rigid& from, const Rigid& to, double share)
{
  return {from.rotation.slerp(share, to.rotation).normalized(),
          (1 - share) * from.translation + share * to.translation};
}
}  // namespace scanloom
