/** The sums over pairs of cells from which a pose's covariance is computed, eight pairs at a time. */
#pragma once
#include "ndt/PairSums.h"
#include "ndt/Symmetric3.h"

namespace scanloom
{
/** GaussianCell::structure of the cells of a TargetBlock; zero where there is no cell. */
struct alignas(64) StructureBlock
{
  double xx[TargetBlock::kLanes], xy[TargetBlock::kLanes], xz[TargetBlock::kLanes];
  double yy[TargetBlock::kLanes], yz[TargetBlock::kLanes], zz[TargetBlock::kLanes];
};

/** With u = Bm and w as in PairSums; T is the target's structure. */
struct PairEvidence
{
  double fx, fy, fz;      // sum w u
  Symmetric3 weight;      // sum w B
  Symmetric3 structured;  // sum w T B T
  Symmetric3 pull;        // sum w (B - d2 u u'): derivative of the force by the distance
};

/** Writes one PairEvidence per source cell; `structures` belong to the blocks. The bits are the same for every kernel.
 */
void gatherEvidence(const PairBatch&, const StructureBlock* structures, double d2, PairEvidence* evidence,
                    Kernel = widestKernel());
}  // namespace scanloom
