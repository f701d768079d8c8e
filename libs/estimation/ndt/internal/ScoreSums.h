/** The innermost sums of a registration: a source cell against its target cells, eight at a time. */
#pragma once
#include "base/core/Kernel.h"

#include <cstddef>
#include <cstdint>

namespace scanloom
{
/** Eight target cells. Places without a cell hold one that is too far away to contribute. */
struct alignas(64) TargetBlock
{
  static constexpr std::size_t kLanes = 8;

  double x[kLanes], y[kLanes], z[kLanes];                                         // m, means
  double xx[kLanes], xy[kLanes], xz[kLanes], yy[kLanes], yz[kLanes], zz[kLanes];  // m^2, covariances

  /** `mean` and `covariance`: any with (row) and (row, column). */
  template <typename Vector, typename Matrix>
  void set(std::size_t lane, const Vector& mean, const Matrix& covariance)
  {
    x[lane] = mean(0), y[lane] = mean(1), z[lane] = mean(2);
    xx[lane] = covariance(0, 0), xy[lane] = covariance(0, 1), xz[lane] = covariance(0, 2);
    yy[lane] = covariance(1, 1), yz[lane] = covariance(1, 2), zz[lane] = covariance(2, 2);
  }
};

/** A source cell in the target's frame. */
struct TurnedCell
{
  double x, y, z;
  double xx, xy, xz, yy, yz, zz;
};

struct BlockRange
{
  std::uint32_t first, count;
};

/** With q = m'Bm of each pair, e = exp(-d2/2 q) and w = d2 e; all in the target's frame. */
struct ScoreSums
{
  double score;                   // sum e
  double best;                    // largest e
  double fx, fy, fz;              // sum w B m
  double xx, xy, xz, yy, yz, zz;  // sum w B
};

/** Source cells and the target cells of each. */
struct PairBatch
{
  const TurnedCell* cells;
  const BlockRange* ranges;  // of each, into blocks
  std::size_t count;
  const TargetBlock* blocks;
};

/** Writes one ScoreSums per source cell. The bits are the same for every kernel. */
void sumPairs(const PairBatch&, double d2, ScoreSums* sums, Kernel = widestKernel());
}  // namespace scanloom
