/** Options of the forest. */
#pragma once
#include "base/config/Schema.h"
#include "lab/simulation/internal/GrowFoliage.h"
#include "lab/simulation/internal/Stand.h"
#include "lab/simulation/internal/Wind.h"

namespace scanloom
{
struct ForestOptions
{
  StandOptions stand;
  TreeOptions trees;
  FoliageOptions foliage;
  WindOptions wind;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.stand, Section{"simulated_stand", "where stems stand"});
    visit(s.trees, Section{"simulated_trees", "how each of them has grown"});
    visit(s.foliage, Section{"simulated_foliage", "twigs, needles, leaves and undergrowth"});
    visit(s.wind, Section{"simulated_wind", "how wind moves stems, branches and leaves"});
  }
};
}  // namespace scanloom
