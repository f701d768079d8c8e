/** Rays through a world that the wind moves: they go through the world at rest along bent ways, in straight pieces. */
#include "lab/simulation/internal/Random.h"
#include "lab/simulation/internal/World.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scanloom
{
namespace
{
constexpr double kPiece = 4;             // m: short against the waves of the wind
constexpr double kShortestPiece = 1e-6;  // m: a shorter one has no direction

/** Range up to which a ray has not risen above a height. */
double rangeBelow(double height, const Ray& ray)
{
  if (ray.direction.z() <= 0) return std::numeric_limits<double>::infinity();
  return (height - ray.origin.z()) / ray.direction.z();
}

/** A straight piece of a ray's way through the world at rest. */
struct PieceAtRest
{
  Ray ray;
  double length;  // m, at rest
  double from;    // m along the ray in the wind
  double stretch;

  PieceAtRest(const Eigen::Vector3d& begin, const Eigen::Vector3d& end, double from_range, double to_range)
    : ray{begin, (end - begin).normalized()},
      length((end - begin).norm()),
      from(from_range),
      stretch((to_range - from_range) / length)
  {
  }

  double rangeOf(double at_rest) const { return from + at_rest * stretch; }
};
}  // namespace

/** A ray on its way. */
struct World::RayInWind
{
  std::size_t query;
  Random of_leaves;
  double reach;          // m
  double optical_depth;  // that is left
  PlaceAtRest at;
};

World::PlaceAtRest World::atRest(const Eigen::Vector3d& place, double t) const
{
  const Eigen::Vector2d p = place.head<2>();
  const WindShift shift = wind_.at(p, place.z() - ground_.smoothHeight(p.x(), p.y()), t);
  PlaceAtRest rest{place, place};
  rest.of_wood.head<2>() -= shift.of_wood;
  rest.of_leaves.head<2>() -= shift.of_leaves;
  return rest;
}

std::vector<std::optional<Hit>> World::castInWind(const std::vector<RayQuery>& queries, double t) const
{
  std::vector<std::optional<Hit>> nearest(queries.size());
  std::vector<RayInWind> rays;
  rays.reserve(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i)
  {
    const auto& [ray, max_range, draw] = queries[i];
    nearest[i] = castFixed(ray, max_range);
    Random of_leaves(draw, RandomStream::Leaves, 0);
    const double optical_depth = of_leaves.exponential();
    const double reach = std::min(nearest[i] ? nearest[i]->range : max_range, rangeBelow(highest_, ray));
    rays.push_back({i, of_leaves, reach, optical_depth, atRest(ray.origin, t)});
  }
  for (double from = 0; !rays.empty(); from += kPiece)
  {
    const auto hasEnded = [&](const RayInWind& ray) { return ray.reach <= from + kShortestPiece; };
    rays.erase(std::remove_if(rays.begin(), rays.end(), hasEnded), rays.end());
    castPiece(queries, from, t, rays, nearest);
  }
  return nearest;
}

/** Takes the rays on by a piece. Those that meet something end there. */
void World::castPiece(const std::vector<RayQuery>& queries, double from, double t, std::vector<RayInWind>& rays,
                      std::vector<std::optional<Hit>>& nearest) const
{
  std::vector<PieceAtRest> of_wood, of_leaves;
  std::vector<FoliageQuery> through_foliage;
  for (RayInWind& ray : rays)
  {
    const double to = std::min(from + kPiece, ray.reach);
    const PlaceAtRest next = atRest(queries[ray.query].ray.at(to), t);
    of_wood.emplace_back(ray.at.of_wood, next.of_wood, from, to);
    of_leaves.emplace_back(ray.at.of_leaves, next.of_leaves, from, to);
    through_foliage.push_back({of_leaves.back().ray, of_leaves.back().length, ray.optical_depth});
    ray.at = next;
  }
  const std::vector<Passage> passages = foliage_.intersect(through_foliage);
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    RayInWind& ray = rays[i];
    ray.optical_depth = passages[i].optical_depth;
    std::optional<Hit> hit;
    if (const auto& leaf = passages[i].leaf)
      hit = Hit{of_leaves[i].rangeOf(leaf->range), std::sqrt(ray.of_leaves.uniform()), leaf->surface, 0};
    const PieceAtRest& piece = of_wood[i];
    if (auto wood = wood_.cast(piece.ray, piece.length))
    {
      wood->range = piece.rangeOf(wood->range);
      if (!hit || wood->range < hit->range) hit = wood;
    }
    if (!hit) continue;
    nearest[ray.query] = hit;
    ray.reach = 0;
  }
}
}  // namespace scanloom
