/** What the lidars send out and what it meets. */
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

/** What a ray is asked: the nearest surface within `max_range`. */
struct RayQuery
{
  Ray ray;
  double max_range;    // m
  std::uint64_t draw;  // decides what is left to chance: of a ray through foliage, which leaf it meets
};

enum class Surface
{
  Ground,
  Stem,         // bark, stumps included
  Branch,       // dead or alive, as far as it is wood
  Crown,        // twigs and needles
  Undergrowth,  // shrubs and grass
  Machine,      // that carries the lidars
  Boom,         // of that machine
  Object,       // that moves by itself
};

constexpr std::size_t kSurfaces = 8;

struct Hit
{
  double range = 0;             // m from the ray's origin
  double cosine_incidence = 0;  // 1 when the ray meets the surface at a right angle
  Surface surface = Surface::Ground;
  std::uint32_t id =
      0;  // of the stem that was hit or that the branch belongs to; 0 elsewhere, for stumps and foliage, too
};
}  // namespace scanloom
