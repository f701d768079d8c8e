/** The sums over pairs of cells from which a pose's covariance is computed, eight pairs at a time. */
#pragma once
#include "ndt/PairSums.h"
#include "ndt/Symmetric3.h"
#include "ndt/SymmetricBlock.h"

namespace scanloom
{
/** With u = Bm and w as in PairSums; T is the target's structure. */
struct PairEvidence
{
  double fx, fy, fz;      // sum w u
  Symmetric3 weight;      // sum w B
  Symmetric3 structured;  // sum w T B T
  Symmetric3 pull;        // sum w (B - d2 u u'): derivative of the force by the distance
};

/**
 * Writes one PairEvidence per source cell; `structures` are GaussianCell::structure of the blocks' cells, zero where
 * there is none. The bits are the same for every kernel.
 */
void gatherEvidence(const PairBatch&, const SymmetricBlock* structures, double d2, PairEvidence* evidence,
                    Kernel = widestKernel());
}  // namespace scanloom
