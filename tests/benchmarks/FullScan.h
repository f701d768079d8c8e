/** Scans the size of two OS0-128, simulated: what registration is measured on. */
#pragma once
#include "estimation/ndt/RayWorld.h"

namespace scanloom
{
/** From the target of a pair to its source. */
inline Rigid fullScanMotion() { return Rigid::fromXyzYawPitchRoll(0.2, 0.1, 0.02, 0.02, 0.005, -0.005); }

/** Two thirds of the rays meet something: repeated with a new phase until the scan has its 262144 points. */
inline std::vector<Eigen::Vector3f> fullScan(const Rigid& world_T_lidar, std::uint64_t seed)
{
  constexpr std::size_t kPoints = 262144;
  const RayLidar two_os0{256, 1024, 0.78, 60, 0.01};
  std::vector<Eigen::Vector3f> points;
  for (; points.size() < kPoints; ++seed)
  {
    const auto more = scanFrom(forest(3), world_T_lidar, seed, two_os0);
    points.insert(points.end(), more.begin(), more.end());
  }
  points.resize(kPoints);
  return points;
}
}  // namespace scanloom
