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
  double voxel = 0.5;
  double leaf_area_density = 0.6;
  double projection = 0.5;
  double gaps = 0.4;
  double undergrowth_cover = 0.15;
  double undergrowth_patch = 1.5;
  double undergrowth_height = 0.4;
  double undergrowth_leaf_area_density = 1.5;
  double undergrowth_lane = 1.4;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.voxel, Field{"voxel", "m",
                         "edge of the cubes that foliage is made of; halving it takes eight times the memory (assumed)",
                         between(0.05, 2)});
    visit(o.leaf_area_density,
          Field{"leaf_area_density", "m2/m3", "mean leaf area density of a crown (assumed)", between(0, 4)});
    visit(o.projection, Field{"projection", "",
                              "share of its area that a leaf shows to a ray; 0.5 for leaves in all "
                              "directions alike (Ross 1981)",
                              between(0.05, 1)});
    visit(o.gaps, Field{"gaps", "", "share of a crown's cubes that are empty (assumed)", between(0, 0.95)});
    visit(o.undergrowth_cover, Field{"undergrowth_cover", "",
                                     "share of the ground that shrubs and grass cover (assumed)", between(0, 0.95)});
    visit(o.undergrowth_patch,
          Field{"undergrowth_patch", "m", "diameter of a patch of undergrowth (assumed)", between(0.3, 20)});
    visit(o.undergrowth_height,
          Field{"undergrowth_height", "m", "mean height in the middle of a patch (assumed)", between(0, 5)});
    visit(o.undergrowth_leaf_area_density, Field{"undergrowth_leaf_area_density", "m2/m3",
                                                 "mean leaf area density of the patches (assumed)", between(0, 4)});
    visit(o.undergrowth_lane,
          Field{"undergrowth_lane", "m", "no undergrowth within this distance of the machine's path (assumed)",
                between(0, 20)});
  }
};

/** Each plant depends on the seed and its place alone. Undergrowth is grown as far as `reach` m from the lane. */
FoliageVoxels growFoliage(const FoliageOptions&, const TreeOptions&, const std::vector<Stem>&, const Ground&,
                          const Lane&, double reach, std::uint64_t seed);
}  // namespace scanloom
