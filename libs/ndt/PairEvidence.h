/** What pairs of cells tell about a pose, eight at a time: the covariance's counterpart of PairSums. */
#pragma once
#include "ndt/PairSums.h"
#include "ndt/Symmetric3.h"

namespace scanloom
{
/** Of a TargetBlock's cells, GaussianCell::structure; zero in a place without a cell. */
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
  Symmetric3 pull;        // sum w (B - d2 u u'): how the force grows with the distance
};

/** One per cell of the batch; `structures` of its blocks. Equal to the bit for every kernel. */
void gatherEvidence(const PairBatch&, const StructureBlock* structures, double d2, PairEvidence* evidence,
                    Kernel = widestKernel());
}  // namespace scanloom
