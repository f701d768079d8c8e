/** The sums over pairs of cells from which a pose's covariance is computed, eight pairs at a time. */
#pragma once
#include "estimation/ndt/internal/ScoreSums.h"
#include "estimation/ndt/internal/Symmetric3.h"
#include "estimation/ndt/internal/SymmetricBlock.h"

namespace scanloom
{
/** With u = Bm and w as in ScoreSums; T is the target's structure. */
struct PairInformation
{
  double fx, fy, fz;      // sum w u
  Symmetric3 weight;      // sum w B
  Symmetric3 structured;  // sum w T B T
  Symmetric3 pull;        // sum w (B - d2 u u'): derivative of the force by the distance
};

/**
 * Writes one PairInformation per source cell; `structures` are GaussianCell::structure of the blocks' cells, zero where
 * there is none. The bits are the same for every kernel.
 */
void gatherPairs(const PairBatch&, const SymmetricBlock* structures, double d2, PairInformation* pairs,
                 Kernel = widestKernel());
}  // namespace scanloom
