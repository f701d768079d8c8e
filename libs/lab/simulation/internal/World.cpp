#include "lab/simulation/internal/World.h"

#include "lab/simulation/internal/GrowFoliage.h"
#include "lab/simulation/internal/Random.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
World::World(const Ground& ground, const ForestOptions& options, const std::vector<Eigen::Vector2d>& path,
             std::uint64_t seed, std::vector<OrientedBox> buildings)
  : World(ground, options, Lane(path), seed, std::move(buildings))
{
}

World::World(const Ground& ground, const ForestOptions& options, const Lane& lane, std::uint64_t seed,
             std::vector<OrientedBox> buildings)
  : World(ground, options, lane, growStand(options.stand, options.trees, ground, lane, seed), seed,
          std::move(buildings))
{
}

World::World(const Ground& ground, const ForestOptions& options, const Lane& lane, Stand stand, std::uint64_t seed,
             std::vector<OrientedBox> buildings)
  : ground_(ground),
    buildings_(std::move(buildings)),
    wind_(options.wind, options.trees.diameter, options.trees.height, seed),
    foliage_(growFoliage(options.foliage, options.trees, stand.stems, ground, lane, options.stand.reach, seed)),
    wood_(std::move(stand.stems), stand.stumps, options.trees),
    highest_(std::max(wood_.highest(), foliage_.voxels().voxelSize() * foliage_.voxels().above()))
{
}

std::vector<std::optional<Hit>> World::castInCalm(const std::vector<RayQuery>& queries) const
{
  std::vector<std::optional<Hit>> nearest(queries.size());
  std::vector<Random> of_leaves;
  std::vector<FoliageQuery> through_foliage;
  of_leaves.reserve(queries.size());
  through_foliage.reserve(queries.size());
  const auto reach = [&](std::size_t i) { return nearest[i] ? nearest[i]->range : queries[i].max_range; };
  for (std::size_t i = 0; i < queries.size(); ++i)
  {
    const auto& [ray, max_range, draw] = queries[i];
    nearest[i] = castFixed(ray, max_range);
    // The exponential distribution has no memory: one draw per ray equals one per voxel.
    of_leaves.emplace_back(draw, RandomStream::Leaves, 0);
    through_foliage.push_back({ray, reach(i), of_leaves.back().exponential()});
  }
  const std::vector<Passage> passages = foliage_.intersect(through_foliage);
  for (std::size_t i = 0; i < queries.size(); ++i)
  {
    // Leaves in all directions alike are met in proportion to the area that they show: the cosine c has density 2c.
    if (const auto& leaf = passages[i].leaf)
      nearest[i] = Hit{leaf->range, std::sqrt(of_leaves[i].uniform()), leaf->surface, 0};
    if (const auto wood = wood_.cast(queries[i].ray, reach(i))) nearest[i] = wood;
  }
  return nearest;
}

std::optional<Hit> World::castFixed(const Ray& ray, double max_range) const
{
  std::optional<Hit> nearest;
  if (const auto range = ground_.intersect(ray, max_range))
  {
    const Eigen::Vector3d p = ray.at(*range);
    nearest = Hit{*range, std::abs(ground_.normal(p.x(), p.y()).dot(ray.direction)), Surface::Ground, 0};
  }
  if (const auto contact = buildings_.cast(ray, nearest ? nearest->range : max_range))
    nearest = Hit{contact->range, contact->cosine_incidence, Surface::Building, 0};
  return nearest;
}
}  // namespace scanloom
