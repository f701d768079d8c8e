#include "simulation/World.h"

#include "simulation/GrowFoliage.h"
#include "simulation/Random.h"

#include <cmath>

namespace scanloom
{
World::World(const Ground& ground, const ForestOptions& options, const std::vector<Eigen::Vector2d>& path,
             std::uint64_t seed)
  : World(ground, options, Lane(path), seed)
{
}

World::World(const Ground& ground, const ForestOptions& options, const Lane& lane, std::uint64_t seed)
  : World(ground, options, lane, growStand(options.stand, options.trees, ground, lane, seed), seed)
{
}

World::World(const Ground& ground, const ForestOptions& options, const Lane& lane, Stand stand, std::uint64_t seed)
  : ground_(ground),
    foliage_(growFoliage(options.foliage, options.trees, stand.stems, ground, lane, options.stand.reach, seed)),
    wood_(std::move(stand.stems), stand.stumps, options.trees)
{
}

std::optional<Hit> World::cast(const Ray& ray, double max_range, std::uint64_t draw) const
{
  std::optional<Hit> nearest;
  const auto reach = [&] { return nearest ? nearest->range : max_range; };
  if (const auto range = ground_.intersect(ray, reach()))
  {
    const Eigen::Vector3d p = ray.at(*range);
    nearest = Hit{*range, std::abs(ground_.normal(p.x(), p.y()).dot(ray.direction)), Surface::Ground, 0};
  }
  // An exponential depth has no memory: one for the whole ray is as good as a new one for every voxel.
  Random random(draw, RandomStream::Leaves, 0);
  const double optical_depth = random.exponential();
  // Leaves that face all directions alike are met in proportion to the area that they show: cosines of density 2c.
  if (const auto leaf = foliage_.intersect(ray, reach(), optical_depth))
    nearest = Hit{leaf->range, std::sqrt(random.uniform()), leaf->surface, 0};
  if (const auto wood = wood_.cast(ray, reach())) nearest = wood;
  return nearest;
}
}  // namespace scanloom
