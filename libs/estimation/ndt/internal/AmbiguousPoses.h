/** Other poses at which two clouds agree as well: stems planted in rows look the same one row further. */
#pragma once
#include "estimation/ndt/Registration.h"

#include <vector>

namespace scanloom
{
/**
 * Poses within three deviations and 5 m of the guess, more than a cell from the result, whose score is at least
 * rival_share of the result's. They are aligned from the local maxima of the score on a grid of shifts. None for a
 * guess without a covariance, or with one of less than two cells.
 */
std::vector<Rigid> ambiguousPoses(const RegistrationLevel&, const RegistrationResult&, const PoseGuess&,
                                  const RegistrationOptions&);

/** Squared Mahalanobis distance from a guess that has a covariance. */
double mahalanobisDistance(const PoseGuess&, const Rigid& pose);
}  // namespace scanloom
