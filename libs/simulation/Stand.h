/** The table of stems: what grows where, from hashed places alone. */
#pragma once
#include "core/Field.h"
#include "simulation/Cone.h"
#include "simulation/Ground.h"
#include "simulation/Lane.h"
#include "simulation/Trees.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
struct StandOptions
{
  double stems_per_hectare = 650;
  double spacing = 1.2;
  double clustering = 0;
  double cluster_size = 6;
  double free_lane = 2.6;
  double reach = 55;
  double stumps_per_hectare = 150;
  double stump_height = 0.25;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.stems_per_hectare, Field{"stems_per_hectare", "1/ha", "density of the stand", between(0, 10000)});
    visit(o.spacing, Field{"spacing", "m", "no two stems nearer to each other (assumed)", between(0.1, 2)});
    visit(o.clustering,
          Field{"clustering", "", "how much denser and thinner groups are than the mean (assumed)", between(0, 0.95)});
    visit(o.cluster_size, Field{"cluster_size", "m", "from one group to the next (assumed)", between(2, 100)});
    visit(o.free_lane, Field{"free_lane", "m", "stems nearer to the machine's path are stumps (assumed)", atLeast(0)});
    visit(o.reach, Field{"reach", "m", "how far from the path the stand is grown (assumed: beyond an OS0's range)",
                         between(1, 500)});
    visit(o.stumps_per_hectare,
          Field{"stumps_per_hectare", "1/ha", "of earlier thinnings (assumed)", between(0, 5000)});
    visit(o.stump_height, Field{"stump_height", "m", "above the ground (assumed)", between(0.02, 1)});
  }
};

struct Stand
{
  std::vector<Stem> stems;
  std::vector<Cone> stumps;
};

/**
 * The stand around a lane. A stem depends on the seed and its place alone: another path through the same place finds
 * the same stem, except for those that it fells. Throws std::invalid_argument if so many stems can't stand so far
 * apart.
 */
Stand growStand(const StandOptions&, const TreeOptions&, const Ground&, const Lane&, std::uint64_t seed);
}  // namespace scanloom
