/** The world beside the machine: ground, buildings, and wood and foliage, which the wind moves. */
#pragma once
#include "lab/simulation/internal/Boxes.h"
#include "lab/simulation/internal/Foliage.h"
#include "lab/simulation/internal/ForestOptions.h"
#include "lab/simulation/internal/Ground.h"
#include "lab/simulation/internal/Ray.h"
#include "lab/simulation/internal/Wind.h"
#include "lab/simulation/internal/Wood.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace scanloom
{
class World
{
 public:
  /**
   * Grows a forest around `path` (in the world, m; points at most 0.25 m apart), among `buildings`. Throws
   * std::invalid_argument that names a wrong option.
   */
  World(const Ground&, const ForestOptions&, const std::vector<Eigen::Vector2d>& path, std::uint64_t seed,
        std::vector<OrientedBox> buildings = {});

  const Ground& ground() const { return ground_; }
  const std::vector<Stem>& stems() const { return wood_.stems(); }
  const Wood& wood() const { return wood_; }
  const Foliage& foliage() const { return foliage_; }
  const Wind& wind() const { return wind_; }

  /**
   * What each ray, given in the world frame, meets `t` s after the start of the recording; without wind all times are
   * alike. Pure; may be called from any thread. Many rays in one call take two thirds of the time of single calls, with
   * the same results.
   */
  std::vector<std::optional<Hit>> cast(const std::vector<RayQuery>& queries, double t = 0) const
  {
    return wind_.isCalm() ? castInCalm(queries) : castInWind(queries, t);
  }
  std::optional<Hit> cast(const RayQuery& query, double t = 0) const
  {
    return cast(std::vector<RayQuery>{query}, t).front();
  }

 private:
  World(const Ground&, const ForestOptions&, const Lane&, std::uint64_t seed, std::vector<OrientedBox>);
  World(const Ground&, const ForestOptions&, const Lane&, Stand, std::uint64_t seed, std::vector<OrientedBox>);

  /** Where things at a place are without wind. */
  struct PlaceAtRest
  {
    Eigen::Vector3d of_wood, of_leaves;
  };
  struct RayInWind;

  std::vector<std::optional<Hit>> castInCalm(const std::vector<RayQuery>&) const;
  std::vector<std::optional<Hit>> castInWind(const std::vector<RayQuery>&, double t) const;
  void castPiece(const std::vector<RayQuery>&, double from, double t, std::vector<RayInWind>&,
                 std::vector<std::optional<Hit>>& nearest) const;
  PlaceAtRest atRest(const Eigen::Vector3d& place, double t) const;
  std::optional<Hit> castFixed(const Ray&, double max_range) const;  // ground and buildings

  Ground ground_;
  Boxes buildings_;
  Wind wind_;
  Foliage foliage_;
  Wood wood_;
  double highest_;  // m: above it there is nothing
};
}  // namespace scanloom
