/** How errors of keyframes grow: each one is aligned to a map that earlier ones, with their errors, have drawn. */
#pragma once
#include "base/core/Rigid.h"

#include <vector>

namespace scanloom
{
/** The error of a keyframe or a map, as a sum of the errors of alignments: the share of each, in their order. */
using ErrorShares = std::vector<double>;

struct WeightedError
{
  double weight;  // positive
  const ErrorShares& error;
};

ErrorShares meanOf(const std::vector<WeightedError>&);

/** `later` minus `earlier`, which knows of no more alignments. */
ErrorShares difference(ErrorShares later, const ErrorShares& earlier);

/**
 * The errors of all alignments, taken as independent of each other.
 *
 * A keyframe errs as the map errs that it was aligned to, and by its own alignment. The map's error is the mean of its
 * keyframes'. So errors grow as a random walk, which is the slower, the longer keyframes stay in the map: its variance
 * grows by that of an alignment for every L^2 keyframes, where those that one is aligned to are L keyframes back in the
 * mean.
 */
class MapDriftModel
{
 public:
  /**
   * The error of a keyframe at `map_T_body` that was aligned to a map with the error `map`. `alignment`: covariance of
   * its pose within the map, in the tangent of boxPlus.
   */
  ErrorShares add(ErrorShares map, const Rigid& map_T_body, const Matrix6d& alignment);

  /** Covariance of an error, as a step of a body at the map's origin: movedTo(map_T_body, ...) is as one of a body
   * there. */
  Matrix6d covariance(const ErrorShares&) const;

 private:
  std::vector<Matrix6d> alignments_;  // as steps of a body at the map's origin
};
}  // namespace scanloom
