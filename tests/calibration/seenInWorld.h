/** What a lidar sees in a world of planes and stems, with a pose in the body that may not be the believed one. */
#pragma once
#include "base/core/Angle.h"
#include "base/core/PointCloud.h"
#include "estimation/ndt/RayWorld.h"

#include <cmath>
#include <vector>

namespace scanloom
{
/** A cloud in the body frame; rings count from the highest beam, as RayLidar's do. */
inline PointCloud cloudIn(const Rigid& body_T_sensor, const std::vector<Eigen::Vector3f>& in_sensor)
{
  PointCloud cloud;
  cloud.resize(in_sensor.size());
  for (std::size_t i = 0; i < in_sensor.size(); ++i)
  {
    const Eigen::Vector3d p = body_T_sensor * in_sensor[i].cast<double>();
    cloud.x[i] = static_cast<float>(p.x());
    cloud.y[i] = static_cast<float>(p.y());
    cloud.z[i] = static_cast<float>(p.z());
    const double altitude = std::atan2(in_sensor[i].z(), in_sensor[i].head<2>().norm());
    cloud.ring[i] = static_cast<std::uint16_t>(std::lround((0.78 - altitude) / (2 * 0.78 / 63)));
  }
  return cloud;
}

inline RayLidar lidar()
{
  RayLidar lidar;
  lidar.beams = 64;
  return lidar;
}

inline Rigid at(double x, double y, double z, double yaw_deg = 0, double pitch_deg = 0, double roll_deg = 0)
{
  return Rigid::fromXyzYawPitchRoll(x, y, z, yaw_deg * kDegree, pitch_deg * kDegree, roll_deg * kDegree);
}

inline PointCloud seen(const RayWorld& world, const Rigid& world_T_body, const Rigid& true_pose,
                       const Rigid& believed_pose, std::uint64_t seed)
{
  return cloudIn(believed_pose, scanFrom(world, world_T_body * true_pose, seed, lidar()));
}
}  // namespace scanloom
