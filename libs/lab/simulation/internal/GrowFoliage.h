/** Foliage in the crowns of a stand and in the undergrowth between its stems. */
#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/FoliageVoxels.h"
#include "lab/simulation/internal/Ground.h"
#include "lab/simulation/internal/Lane.h"
#include "lab/simulation/internal/Stand.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
struct FoliageOptions
{
  double leaf_area_density = 0.6;  // m2/m3: mean leaf area density of a crown
  double undergrowth_cover = 0.15;
  double undergrowth_height = 0.4;
  double undergrowth_leaf_area_density = 1.5;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.undergrowth_cover, Field{"undergrowth_cover", "",
                                     "share of the ground that shrubs and grass cover (assumed)", between(0, 0.95)});
    visit(o.undergrowth_height,
          Field{"undergrowth_height", "m", "mean height in the middle of a patch (assumed)", between(0, 5)});
    visit(o.undergrowth_leaf_area_density, Field{"undergrowth_leaf_area_density", "m2/m3",
                                                 "mean leaf area density of the patches (assumed)", between(0, 4)});
  }
};

/** Each plant depends on the seed and its place alone. Undergrowth is grown as far as `reach` m from the lane. */
FoliageVoxels growFoliage(const FoliageOptions&, const TreeOptions&, const std::vector<Stem>&, const Ground&,
                          const Lane&, double reach, std::uint64_t seed);
}  // namespace scanloom
