/** A drive of 15 m among stems with two lidars, whose poses and path are known. */
#pragma once
#include "base/core/StampedPose.h"
#include "calibration/internal/LidarScans.h"
#include "calibration/seenInWorld.h"

#include <vector>

namespace scanloom
{
inline const Rigid kLeft = at(1.5, 1.2, 2.5, 30, 15, -25), kRight = at(1.5, -1.2, 2.5, -30, 15, 25);

/** A winding path at 1 m/s, turning by up to 0.3 rad/s; at rest with speed 0. */
inline Rigid bodyAt(double t, double speed)
{
  return at(speed * t, speed * std::sin(0.3 * t), 0, speed * 20 * std::sin(t), 0, 0);
}

struct DriveOfTwo
{
  Trajectory trajectory;
  std::vector<LidarScan> left, right;
};

inline LidarScan scanAt(double t, double late, double speed, const Rigid& body_T_sensor, std::uint64_t seed)
{
  LidarScan scan;
  scan.start = Timestamp{fromSeconds(t + late)};
  scan.points = scanFrom(forest(1), bodyAt(t, speed) * body_T_sensor, seed, lidar());
  scan.t.assign(scan.points.size(), 0);
  return scan;
}

inline DriveOfTwo driven(double speed, double late = 0)
{
  DriveOfTwo drive;
  for (int i = 0; i <= 1600; ++i) drive.trajectory.push_back({Timestamp{i * 10ms}, bodyAt(0.01 * i, speed)});
  for (int i = 1; i <= 15; ++i)
  {
    const auto seed = static_cast<std::uint64_t>(i);
    drive.left.push_back(scanAt(i, 0, speed, kLeft, seed));
    drive.right.push_back(scanAt(i, late, speed, kRight, 100 + seed));
  }
  return drive;
}
}  // namespace scanloom
