#pragma once
#include <cstddef>

namespace scanloom
{
/** Eight symmetric 3x3 matrices. */
struct alignas(64) SymmetricBlock
{
  static constexpr std::size_t kLanes = 8;

  double xx[kLanes], xy[kLanes], xz[kLanes], yy[kLanes], yz[kLanes], zz[kLanes];
};

/** `matrix`: any with (row, column). */
template <typename Matrix>
void put(const Matrix& matrix, SymmetricBlock& block, std::size_t lane)
{
  block.xx[lane] = matrix(0, 0), block.xy[lane] = matrix(0, 1), block.xz[lane] = matrix(0, 2);
  block.yy[lane] = matrix(1, 1), block.yz[lane] = matrix(1, 2), block.zz[lane] = matrix(2, 2);
}
}  // namespace scanloom
