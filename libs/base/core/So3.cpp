#include "base/core/So3.h"

#include <cmath>

namespace scanloom
{
namespace
{
// Below this angle the closed forms lose digits, and two terms of the series are exact.
constexpr double kSmallAngle = 1e-4;
// Above -1 by less than this, the cosine is that of opposite directions: every axis across them will do.
constexpr double kOpposite = 1e-12;
}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& v)
{
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Quaterniond expSo3(const Eigen::Vector3d& v)
{
  const double angle = v.norm();
  const double scale = angle < kSmallAngle ? 0.5 - angle * angle / 48 : std::sin(0.5 * angle) / angle;
  Eigen::Quaterniond q;
  q.w() = std::cos(0.5 * angle);
  q.vec() = scale * v;
  return q.normalized();
}

Eigen::Quaterniond rotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
  // Not Eigen's FromTwoVectors(): for the sake of opposite directions it takes 10 s to compile.
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  if (cosine < kOpposite - 1) return Eigen::Quaterniond(Eigen::AngleAxisd(EIGEN_PI, a.unitOrthogonal()));
  const double twice_half_cosine = std::sqrt((1 + cosine) * 2);
  Eigen::Quaterniond q;
  q.vec() = a.cross(b) * (1 / twice_half_cosine);
  q.w() = twice_half_cosine * 0.5;
  return q;
}

Eigen::Vector3d logSo3(const Eigen::Quaterniond& q)
{
  const double sign = q.w() < 0 ? -1.0 : 1.0;  // q and -q are the same rotation: take the shorter vector
  const double sine = q.vec().norm();
  const double cosine = sign * q.w();
  const double scale = sine < kSmallAngle ? 2 / cosine - 2 * sine * sine / (3 * cosine * cosine * cosine)
                                          : 2 * std::atan2(sine, cosine) / sine;
  return sign * scale * q.vec();
}

Eigen::Matrix3d rightJacobianSo3(const Eigen::Vector3d& v)
{
  const double angle = v.norm();
  const Eigen::Matrix3d w = skew(v);
  const double a2 = angle * angle;
  const double first = angle < kSmallAngle ? 0.5 - a2 / 24 : (1 - std::cos(angle)) / a2;
  const double second = angle < kSmallAngle ? 1.0 / 6 - a2 / 120 : (angle - std::sin(angle)) / (a2 * angle);
  return Eigen::Matrix3d::Identity() - first * w + second * w * w;
}

Eigen::Matrix3d rightJacobianInverseSo3(const Eigen::Vector3d& v)
{
  const double angle = v.norm();
  const Eigen::Matrix3d w = skew(v);
  const double second = angle < kSmallAngle ? 1.0 / 12 + angle * angle / 720
                                            : 1 / (angle * angle) - 0.5 / (angle * std::tan(0.5 * angle));
  return Eigen::Matrix3d::Identity() + 0.5 * w + second * w * w;
}
}  // namespace scanloom
