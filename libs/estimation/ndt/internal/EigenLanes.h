/** Eigenvalues and eigenvectors of symmetric 3x3 matrices, eight at a time. */
#pragma once
#include "base/core/Kernel.h"
#include "estimation/ndt/internal/SymmetricBlock.h"

#include <Eigen/Core>

#include <cstddef>

namespace scanloom
{
/** `vectors[i]` is the unit vector of `values[i]`; they are in no order. */
struct alignas(64) EigenBlock
{
  double values[3][SymmetricBlock::kLanes];
  double vectors[3][3][SymmetricBlock::kLanes];

  Eigen::Vector3d valuesOf(std::size_t lane) const { return {values[0][lane], values[1][lane], values[2][lane]}; }
  Eigen::Vector3d vectorOf(std::size_t i, std::size_t lane) const
  {
    return {vectors[i][0][lane], vectors[i][1][lane], vectors[i][2][lane]};
  }
};

/**
 * Computed by Jacobi's rotations (G. Golub and C. Van Loan: Matrix Computations, 4th edition, 8.5), to 1e-9 of the
 * largest eigenvalue. Entries must be finite, and 0 or above 1e-150 in size. The bits are the same for every kernel.
 */
EigenBlock eigensystemsOf(const SymmetricBlock&, Kernel = widestKernel());
}  // namespace scanloom
