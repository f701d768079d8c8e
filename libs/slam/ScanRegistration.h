/** A scan's pose in the local map. */
#pragma once
#include "core/StageTimes.h"
#include "slam/SlamSettings.h"

#include <optional>

namespace scanloom
{
/**
 * Roughly from the guess, then finely from there (paper, section 2.2); through coarser cells first where the guess may
 * be off by more than those of [scan_cells] reach. What the result says is the lidar's alone: a guess that is surer
 * than that chooses where to begin and nothing else.
 */
RegistrationResult registerScan(const NdtMap& map, const std::vector<View>& seen_from_body, const PoseGuess& map_T_body,
                                const SlamSettings&, StageTimes&);

/** Where a lost body may be: that far to each side (m), turned by any of so many headings, the pose's own among them.
 */
struct SearchArea
{
  Rigid map_T_body;
  double radius = 3;
  int headings = 8;  // what is within 25 deg of one is found: 8 are all around
};

/**
 * Of a pose found there: the lidar's, but what the lidar leaves open is known as well as the search knew it before. At
 * most the area to each side, any heading or 25 deg, and a tilt that is off by 15 deg.
 */
Matrix6d covarianceWithin(const SearchArea&, const RegistrationResult&);

/** Nothing if no pose in it is trustworthy, or if another one far from the best is nearly as good. */
std::optional<RegistrationResult> relocalise(const NdtMap& map, const std::vector<View>& seen_from_body,
                                             const SearchArea&, const SlamSettings&);
}  // namespace scanloom
