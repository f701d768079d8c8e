/** What stands still around the machine: ground and stand. */
#pragma once
#include "simulation/Ground.h"
#include "simulation/Ray.h"
#include "simulation/Stand.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace scanloom
{
class World
{
 public:
  /** A stand grown on the ground as far around `path` (m, in the world) as a lidar sees. */
  World(const Ground&, const StandOptions&, const std::vector<Eigen::Vector2d>& path, std::uint64_t seed);

  const Ground& ground() const { return ground_; }
  const std::vector<Stem>& stems() const { return stand_.stems(); }

  /**
   * The nearest surface within `max_range`. `draw` decides what is left to chance: of a ray through foliage, which
   * leaf it meets. Pure, so that any thread may ask at any time: the same arguments, the same answer.
   */
  std::optional<Hit> cast(const Ray& ray_in_world, double max_range, std::uint64_t draw) const;

 private:
  Ground ground_;
  Stand stand_;
};
}  // namespace scanloom
