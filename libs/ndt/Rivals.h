/** Other places where two clouds agree as well: stems planted in rows look the same from the next one. */
#pragma once
#include "ndt/Registration.h"

#include <vector>

namespace scanloom
{
/**
 * Poses within three deviations of the guess, more than a cell from `best`, where the score is at least `share` of that
 * at `best`: the best of each hill of the score on a grid of shifts along the guess's two most uncertain directions of
 * translation, aligned. None for a guess without a covariance, or with one within a cell.
 */
std::vector<Rigid> rivalsOf(const RegistrationLevel&, const Rigid& best, const PoseGuess&, const RegistrationOptions&,
                            double share);

/** Squared Mahalanobis distance from a guess that has a covariance. */
double surprise(const PoseGuess&, const Rigid& pose);
}  // namespace scanloom
