/** Scans of a lidar that stands still in a simulated stand: the pose of each is known exactly. */
#pragma once
#include "base/config/Configuration.h"
#include "base/core/Rigid.h"
#include "lab/simulation/RecordingOptions.h"
#include "lab/simulation/internal/Random.h"
#include "lab/simulation/internal/World.h"

#include <string>
#include <vector>

namespace scanloom
{
/** 90 degrees of beams, like an OS0. */
struct ForestLidar
{
  int beams = 128;
  int columns = 1024;
  double max_range = 50;  // m
  double noise = 0.02;    // m
};

/** `stand`: a file of params/simulation without its ending. */
inline World standAround(const std::string& stand, double length, std::uint64_t seed)
{
  const auto file = std::string(SCANLOOM_SOURCE_DIR) + "/params/simulation/" + stand + ".ini";
  const auto settings =
      readSettings<SimulationSettings>(Configuration::fromFiles({file}), schemaOf<SimulationSettings>());
  std::vector<Eigen::Vector2d> path;
  for (double x = 0; x <= length; x += 0.25) path.emplace_back(x, 0);
  return World(Ground(settings.ground), settings.forest, path, seed);
}

/** 2.5 m above the ground at x on the lane's middle. */
inline Rigid poseInStand(const World& world, double x, const Eigen::Vector3d& yaw_pitch_roll)
{
  return Rigid::fromXyzYawPitchRoll(x, 0, world.ground().height(x, 0.0) + 2.5, yaw_pitch_roll.x(), yaw_pitch_roll.y(),
                                    yaw_pitch_roll.z());
}

/** In the lidar's frame; `scan` makes its leaves, its noise and where its columns begin differ from other scans'. */
inline std::vector<Eigen::Vector3f> forestScan(const World& world, const Rigid& world_T_lidar, const ForestLidar& lidar,
                                               std::uint64_t scan)
{
  Random random(scan, RandomStream::Lidar, 0);
  const double phase = random.uniform();
  std::vector<RayQuery> column(static_cast<std::size_t>(lidar.beams));
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < lidar.columns; ++i)
  {
    const double azimuth = 2 * M_PI * (i + phase) / lidar.columns;
    std::vector<Eigen::Vector3d> directions;
    for (int k = 0; k < lidar.beams; ++k)
    {
      const double altitude = M_PI / 4 * (1 - 2.0 * k / (lidar.beams - 1));
      directions.emplace_back(std::cos(azimuth) * std::cos(altitude), std::sin(azimuth) * std::cos(altitude),
                              std::sin(altitude));
      column[static_cast<std::size_t>(k)] = {{world_T_lidar.translation, world_T_lidar.rotation * directions.back()},
                                             lidar.max_range,
                                             (scan << 32) + static_cast<std::uint64_t>(i * lidar.beams + k)};
    }
    const auto hits = world.cast(column);
    for (std::size_t k = 0; k < hits.size(); ++k)
    {
      if (!hits[k]) continue;
      points.push_back((directions[k] * (hits[k]->range + lidar.noise * random.normal())).cast<float>());
    }
  }
  return points;
}
}  // namespace scanloom
