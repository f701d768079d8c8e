#include "simulation/World.h"

#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kBeyondReach = 45.0;  // m: no stem farther from the path

Stand growStand(const StandOptions& options, const Ground& ground, const std::vector<Eigen::Vector2d>& path,
                std::uint64_t seed)
{
  Eigen::AlignedBox2d area;
  for (const Eigen::Vector2d& p : path) area.extend(p);
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kBeyondReach);
  area = {area.min() - margin, area.max() + margin};
  return Stand(growStems(options, ground, area, path, seed));
}
}  // namespace

World::World(const Ground& ground, const StandOptions& options, const std::vector<Eigen::Vector2d>& path,
             std::uint64_t seed)
  : ground_(ground), stand_(growStand(options, ground, path, seed))
{
}

std::optional<Hit> World::cast(const Ray& ray, double max_range, std::uint64_t /*draw*/) const
{
  std::optional<Hit> nearest;
  if (const auto bark = stand_.intersect(ray, max_range))
  {
    const Eigen::Vector3d normal = bark->stem->normal(ray.at(bark->range));
    const auto id = static_cast<std::uint32_t>(bark->stem - stand_.stems().data());
    nearest = Hit{bark->range, std::abs(normal.dot(ray.direction)), Surface::Stem, id};
  }
  if (const auto range = ground_.intersect(ray, nearest ? nearest->range : max_range))
  {
    const Eigen::Vector3d p = ray.at(*range);
    nearest = Hit{*range, std::abs(ground_.normal(p.x(), p.y()).dot(ray.direction)), Surface::Ground, 0};
  }
  return nearest;
}
}  // namespace scanloom
