/** Results of `slam` as folders, of drives through a stand of stems, without running it. */
#pragma once
#include "base/formats/Trajectory.h"
#include "estimation/slam/StandOfStems.h"
#include "mrpt/maps/KeyframeTable.h"
#include "mrpt/maps/SimpleMapFile.h"

#include <filesystem>
#include <vector>

namespace scanloom
{
struct DriveOfStems
{
  std::vector<Rigid> world_T_body;  // of its keyframes, ten seconds apart
  Timestamp start{1000s};
  double turn_error = 0;                   // rad, of the heading from each keyframe to the next
  std::size_t lost_at = 0;                 // the keyframe with which a new map begins; 0: none
  Rigid lost_T_found = Rigid::identity();  // error of the poses from there on

  Timestamp stampOf(std::size_t i) const { return start + 10s * static_cast<std::int64_t>(i); }

  /** As an odometry has it that begins in its own frame and turns wrongly. */
  std::vector<Rigid> estimated() const
  {
    const Rigid turn = Rigid::fromXyzYawPitchRoll(0, 0, 0, turn_error, 0, 0);
    std::vector<Rigid> poses{Rigid::identity()};
    for (std::size_t i = 1; i < world_T_body.size(); ++i)
    {
      const Rigid step = world_T_body[i - 1].inverse() * world_T_body[i];
      poses.push_back(poses.back() * step * turn * (lost_at > 0 && i == lost_at ? lost_T_found : Rigid::identity()));
    }
    return poses;
  }

  /** A folder of results, with the maps of what is seen in the stand. */
  void write(const std::filesystem::path& folder, const StandOfStems& stand) const
  {
    std::filesystem::create_directories(folder);
    Vector6d sigma;
    sigma << 0.01, 0.01, 0.005, 5e-4, 5e-4, 2e-3;
    SimpleMapWriter map(folder / "keyframes.simplemap", {{"left", Rigid::fromXyzYawPitchRoll(0, 0, 3, 0, 0, 0)}});
    KeyframeTableWriter table(folder / "keyframes.csv");
    Trajectory trajectory;
    const std::vector<Rigid> poses = estimated();
    for (std::size_t i = 0; i < poses.size(); ++i)
    {
      PointCloud points = stand.scanAt(stampOf(i), [&](Timestamp) { return world_T_body[i]; }).points;
      map.add({{stampOf(i), poses[i], std::move(points)}, sigma.cwiseAbs2().asDiagonal()});
      table.add({stampOf(i), i > 0 && i == lost_at, sigma.cwiseAbs2().asDiagonal()});
      trajectory.push_back({stampOf(i), poses[i]});
    }
    map.close();
    table.close();
    writeTum(folder / "trajectory.tum", trajectory);
  }
};

/** From x = `from` on, a keyframe every 4 m, and back with the opposite heading 1 m to the left. */
inline std::vector<Rigid> thereAndBack(double from, int steps)
{
  std::vector<Rigid> poses;
  for (int i = 0; i <= steps; ++i) poses.push_back(Rigid::fromXyzYawPitchRoll(from + 4 * i, 0, 0, 0.05, 0, 0));
  for (int i = steps; i >= 0; --i) poses.push_back(Rigid::fromXyzYawPitchRoll(from + 4 * i, 1, 0, M_PI, 0, 0));
  return poses;
}

inline std::vector<Rigid> straight(double from, double y, int steps)
{
  std::vector<Rigid> poses;
  for (int i = 0; i <= steps; ++i) poses.push_back(Rigid::fromXyzYawPitchRoll(from + 4 * i, y, 0, 0, 0, 0));
  return poses;
}
}  // namespace scanloom
