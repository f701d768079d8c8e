/** Rays, and what they meet. */
#pragma once
#include <Eigen/Core>

#include <cstddef>
#include <cstdint>

namespace scanloom
{
struct Ray
{
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  // unit

  Eigen::Vector3d at(double range) const { return origin + range * direction; }
};

/** Asks for the nearest surface within `max_range`. */
struct RayQuery
{
  Ray ray;
  double max_range;    // m
  std::uint64_t draw;  // key of the random numbers: which leaf a ray through foliage meets
};

enum class Surface
{
  Ground,
  Stem,         // bark, stumps included
  Branch,       // its wood, dead or alive
  Crown,        // twigs and needles
  Undergrowth,  // shrubs and grass
  Machine,      // the one that carries the lidars
  Boom,         // of that machine
  Object,       // persons, vehicles, falling trees
  Building,     // walls and whatever else stands still and was built
  Precipitation,
};

constexpr std::size_t kSurfaces = 10;

struct Hit
{
  double range = 0;             // m from the ray's origin
  double cosine_incidence = 0;  // 1 when the ray meets the surface at a right angle
  Surface surface = Surface::Ground;
  std::uint32_t id = 0;  // number of the stem that was hit, or whose branch; 0 for everything else
};
}  // namespace scanloom
