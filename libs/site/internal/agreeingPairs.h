#pragma once
#include "base/positions/PositionTrack.h"

#include <vector>

namespace scanloom
{
/**
 * Indices of the pairs that one alignment by yaw explains, of all alignments by two of them the one that explains most.
 * `sigma`: of the references (m), of which three deviations are agreement, and so is a trajectory's own drift: 1 m, and
 * 1 % of the distance from the two. Empty unless that is at
 * least half of five pairs or more, the farthest of them 10 m apart.
 */
std::vector<std::size_t> agreeingPairs(const std::vector<PositionPair>&, double sigma);
}  // namespace scanloom
