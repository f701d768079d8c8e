/** A world of planes and upright cylinders seen by a spinning lidar without motion: exact answers for registration. */
#pragma once
#include "base/core/Rigid.h"

#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace scanloom
{
struct RayWorld
{
  struct Plane
  {
    Eigen::Vector3d normal;  // unit; normal . p = offset
    double offset;
  };
  struct Stem
  {
    Eigen::Vector2d centre;
    double radius;
  };
  std::vector<Plane> planes;
  std::vector<Stem> stems;

  /** Distance to the first surface along a unit direction. */
  std::optional<double> range(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double farthest) const
  {
    double nearest = farthest;
    const auto meet = [&nearest](double distance)
    {
      if (distance > 0 && distance < nearest) nearest = distance;
    };
    for (const Plane& plane : planes) meet((plane.offset - plane.normal.dot(from)) / plane.normal.dot(direction));
    for (const Stem& stem : stems)
    {
      const Eigen::Vector2d d = direction.head<2>(), to = stem.centre - from.head<2>();
      const double along = d.dot(to),
                   inside = along * along - d.squaredNorm() * (to.squaredNorm() - stem.radius * stem.radius);
      if (inside > 0) meet((along - std::sqrt(inside)) / d.squaredNorm());
    }
    return nearest < farthest ? std::optional<double>(nearest) : std::nullopt;
  }
};

/** Unit vector in a lidar's frame; rad, the azimuth from x towards y, the elevation upwards. */
inline Eigen::Vector3d rayAt(double azimuth, double elevation)
{
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

struct RayLidar
{
  int beams = 128;
  int columns = 512;
  double half_fov = 0.78;  // rad, up and down
  double farthest = 40;    // m
  double noise = 0.01;     // m, standard deviation of the range
};

/** Points in the lidar's frame; the phase of the columns is random as well. */
inline std::vector<Eigen::Vector3f> scanFrom(const RayWorld& world, const Rigid& world_T_lidar, std::uint64_t seed,
                                             const RayLidar& lidar = {})
{
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0, lidar.noise);
  const double phase = std::uniform_real_distribution<double>(0, 2 * M_PI / lidar.columns)(random);
  std::vector<Eigen::Vector3f> points;
  for (int column = 0; column < lidar.columns; ++column)
    for (int beam = 0; beam < lidar.beams; ++beam)
    {
      const double azimuth = phase + 2 * M_PI * column / lidar.columns;
      const double elevation = lidar.half_fov * (1 - 2.0 * beam / (lidar.beams - 1));
      const Eigen::Vector3d ray = rayAt(azimuth, elevation);
      if (const auto range = world.range(world_T_lidar.translation, world_T_lidar.rotation * ray, lidar.farthest))
        points.push_back(((*range + noise(random)) * ray).cast<float>());
    }
  return points;
}

/** Ground that slopes a little, and stems at random places outside a clearing. */
inline RayWorld forest(std::uint64_t seed, int stems = 120)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-30, 30), radius(0.08, 0.25);
  RayWorld world{{{Eigen::Vector3d(0.03, -0.02, 1).normalized(), -2.0}}, {}};
  while (static_cast<int>(world.stems.size()) < stems)
  {
    const double y = place(random), x = place(random);  // as arguments, their order would be the compiler's choice
    const Eigen::Vector2d centre(x, y);
    if (centre.norm() > 2.5) world.stems.push_back({centre, radius(random)});
  }
  return world;
}

/** Endless along x. */
inline RayWorld corridor()
{
  return {{{Eigen::Vector3d::UnitY(), -2.1},
           {Eigen::Vector3d::UnitY(), 2.3},
           {Eigen::Vector3d::UnitZ(), -1.6},
           {Eigen::Vector3d::UnitZ(), 1.5}},
          {}};
}

inline RayWorld wall() { return {{{Eigen::Vector3d::UnitX(), 5.0}}, {}}; }

/** Equal stems on flat ground, `spacing` m apart in both directions. */
inline RayWorld plantation(double spacing)
{
  RayWorld world{{{Eigen::Vector3d::UnitZ(), -2.0}}, {}};
  for (int i = -12; i <= 12; ++i)
    for (int j = -12; j <= 12; ++j) world.stems.push_back({{spacing * (i + 0.5), spacing * (j + 0.5)}, 0.15});
  return world;
}

inline RayWorld openField() { return {{{Eigen::Vector3d::UnitZ(), -2.0}}, {}}; }
}  // namespace scanloom
