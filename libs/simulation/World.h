/** The static world: ground, wood and foliage. */
#pragma once
#include "simulation/Foliage.h"
#include "simulation/ForestOptions.h"
#include "simulation/Ground.h"
#include "simulation/Ray.h"
#include "simulation/Wood.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace scanloom
{
class World
{
 public:
  /**
   * Grows a forest around `path` (in the world, m; points at most 0.25 m apart). Throws std::invalid_argument that
   * names a wrong option.
   */
  World(const Ground&, const ForestOptions&, const std::vector<Eigen::Vector2d>& path, std::uint64_t seed);

  const Ground& ground() const { return ground_; }
  const std::vector<Stem>& stems() const { return wood_.stems(); }
  const Wood& wood() const { return wood_; }
  const Foliage& foliage() const { return foliage_; }

  /**
   * What each ray, given in the world frame, meets. Pure; may be called from any thread. Many rays in one call take two
   * thirds of the time of single calls, with the same results.
   */
  std::vector<std::optional<Hit>> cast(const std::vector<RayQuery>&) const;
  std::optional<Hit> cast(const RayQuery& query) const { return cast(std::vector<RayQuery>{query}).front(); }

 private:
  World(const Ground&, const ForestOptions&, const Lane&, std::uint64_t seed);
  World(const Ground&, const ForestOptions&, const Lane&, Stand, std::uint64_t seed);

  std::optional<Hit> castGround(const Ray&, double max_range) const;

  Ground ground_;
  Foliage foliage_;
  Wood wood_;
};
}  // namespace scanloom
