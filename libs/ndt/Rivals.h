/** Other places where two clouds agree as well: stems planted in rows look the same from the next one. */
#pragma once
#include "ndt/Registration.h"

#include <vector>

namespace scanloom
{
/**
 * Poses within three deviations and 5 m of the guess, more than a cell from the result, whose score is at least
 * rival_share of the result's: the hills of the score on a grid of shifts, aligned. None for a guess without a
 * covariance, or with one within two cells.
 */
std::vector<Rigid> rivalsOf(const RegistrationLevel&, const RegistrationResult&, const PoseGuess&,
                            const RegistrationOptions&);

/** Squared Mahalanobis distance from a guess that has a covariance. */
double surprise(const PoseGuess&, const Rigid& pose);
}  // namespace scanloom
