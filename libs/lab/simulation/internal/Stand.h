/** Stems and stumps of a stand. */
#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/Cone.h"
#include "lab/simulation/internal/Ground.h"
#include "lab/simulation/internal/Lane.h"
#include "lab/simulation/internal/Trees.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
struct StandOptions
{
  double stems_per_hectare = 650;
  double spacing = 1.2;
  double clustering = 0;
  double row_distance = 0;
  int seed = 0;
  double felled = 0;
  double reach = 55;  // m: the stand is grown within this distance of the path (assumed: beyond an OS0's range)
  double stumps_per_hectare = 150;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.stems_per_hectare, Field{"stems_per_hectare", "1/ha", "number of stems per hectare", between(0, 10000)});
    visit(o.spacing, Field{"spacing", "m", "smallest distance of two stems (assumed)", between(0.1, 2)});
    visit(o.clustering, Field{"clustering", "",
                              "how much denser and thinner the stand is in places, as a share of the mean (assumed)",
                              between(0, 0.95)});
    visit(o.row_distance, Field{"row_distance", "m",
                                "distance of the rows of a plantation, along the axis of the path; a stem stands every "
                                "two thirds of it in each row; 0: stems_per_hectare in random places",
                                between(0, 10)});
    visit(o.seed,
          Field{"seed", "",
                "which stand, or which buildings: drives of different seeds through one; 0: the seed of the drive",
                atLeast(0)});
    visit(o.felled,
          Field{"felled", "", "share of the stems that were felled to stumps since an earlier drive", between(0, 1)});
    visit(o.stumps_per_hectare, Field{"stumps_per_hectare", "1/ha",
                                      "number of stumps of earlier thinnings per hectare (assumed)", between(0, 5000)});
  }
};

struct Stand
{
  std::vector<Stem> stems;
  std::vector<Cone> stumps;
};

/**
 * The stand around a lane. A stem depends on the seed and its place alone, so that other paths find the same stems
 * except for those that they fell. Throws std::invalid_argument if there is no room for so many stems at that spacing.
 */
Stand growStand(const StandOptions&, const TreeOptions&, const Ground&, const Lane&, std::uint64_t seed);
}  // namespace scanloom
