#pragma once
#include <cstddef>

namespace scanloom
{
/** Eight symmetric 3x3 matrices. */
struct alignas(64) SymmetricBlock
{
  static constexpr std::size_t kLanes = 8;

  double xx[kLanes], xy[kLanes], xz[kLanes], yy[kLanes], yz[kLanes], zz[kLanes];

  /** `matrix`: any with (row, column). */
  template <typename Matrix>
  void set(std::size_t lane, const Matrix& matrix)
  {
    xx[lane] = matrix(0, 0), xy[lane] = matrix(0, 1), xz[lane] = matrix(0, 2);
    yy[lane] = matrix(1, 1), yz[lane] = matrix(1, 2), zz[lane] = matrix(2, 2);
  }
};
}  // namespace scanloom
