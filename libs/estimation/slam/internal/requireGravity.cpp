#include "estimation/slam/internal/requireGravity.h"

#include "estimation/imu/MeanForce.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
void requireGravity(const std::vector<ImuSample>& samples, const Rigid& body_T_imu)
{
  constexpr double kSteepest = 60;  // deg
  const std::optional<Eigen::Vector3d> force = meanForce(samples);
  if (!force) return;
  const ForceUnit unit = forceUnitOf(force->norm());
  if (unit != ForceUnit::MetresPerSecondSquared && unit != ForceUnit::Unclear)
    throw std::runtime_error(
        fmt::format("the IMU's mean specific force is {:.3g} m/s2: {}", force->norm(), adviceFor(unit)));
  const Eigen::Vector3d up = body_T_imu.rotation * force->normalized();
  if (degreesBetween(up, Eigen::Vector3d::UnitZ()) > kSteepest)
    throw std::runtime_error(
        fmt::format("by the IMU up is along {} of the body: its pose in the body is wrong by {}, or the signs of its "
                    "accelerometer are",
                    nearestAxis(up), turnUpwards(up)));
}
}  // namespace scanloom
