#include "estimation/imu/MeanForce.h"

#include "base/core/Angle.h"
#include "estimation/imu/NavState.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kUnitTolerance = 0.2;  // a scale of an axis is never that wrong

bool isAbout(double value, double unit) { return std::abs(value / unit - 1) < kUnitTolerance; }
}  // namespace

std::optional<Eigen::Vector3d> meanForce(const std::vector<ImuSample>& samples)
{
  if (samples.empty()) return std::nullopt;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const ImuSample& sample : samples) sum += sample.accel;
  return sum / static_cast<double>(samples.size());
}

ForceUnit forceUnitOf(double magnitude)
{
  if (isAbout(magnitude, kGravity)) return ForceUnit::MetresPerSecondSquared;
  if (isAbout(magnitude, 1)) return ForceUnit::StandardGravity;
  if (isAbout(magnitude, 1000)) return ForceUnit::MilliGravity;
  return magnitude < 0.5 ? ForceUnit::GravityTakenOut : ForceUnit::Unclear;
}

std::string adviceFor(ForceUnit unit)
{
  switch (unit)
  {
    case ForceUnit::MetresPerSecondSquared:
      return "";
    case ForceUnit::StandardGravity:
      return "the values are in g: multiply them by 9.80665";
    case ForceUnit::MilliGravity:
      return "the values are in mg (or cm/s2): multiply them by 0.00980665 (or 0.01)";
    case ForceUnit::GravityTakenOut:
      return "gravity was taken out by the IMU: record its raw accelerometer, not 'linear acceleration'";
    case ForceUnit::Unclear:
      break;
  }
  return "at rest it must be 9.81 m/s2: check the unit and the full-scale setting";
}

std::string nearestAxis(const Eigen::Vector3d& direction)
{
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return fmt::format("{}{}", direction[axis] < 0 ? '-' : '+', "xyz"[axis]);
}

double degreesBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
}

std::string turnUpwards(const Eigen::Vector3d& up_in_body)
{
  const double angle = degreesBetween(up_in_body, Eigen::Vector3d::UnitZ());
  if (angle > 170) return "180 deg about x or y";
  Eigen::Vector3d axis = up_in_body.cross(Eigen::Vector3d::UnitZ()).normalized();
  const std::string name = nearestAxis(axis);
  Eigen::Index index = 0;
  const double aligned = axis.cwiseAbs().maxCoeff(&index);
  if (aligned > std::cos(15 * kDegree)) return fmt::format("{}{:.0f} deg about {}", name[0], angle, name[1]);
  return fmt::format("{:.0f} deg about the axis ({:.2f} {:.2f} {:.2f})", angle, axis.x(), axis.y(), axis.z());
}
}  // namespace scanloom
