#include "estimation/graph/internal/Whitening.h"

#include "base/core/Decompositions.h"

#include <Eigen/Cholesky>

namespace scanloom
{
namespace
{
template <typename Matrix>
Matrix rootOf(const Matrix& covariance)
{
  const Matrix lower = covariance.llt().matrixL();
  return lower.template triangularView<Eigen::Lower>().solve(Matrix::Identity());
}
}  // namespace

Matrix6d rootOfInformation(const Matrix6d& information)
{
  const Eigensystem6 eigen = eigensystem(0.5 * (information + information.transpose()));
  return eigen.values.cwiseMax(0).cwiseSqrt().asDiagonal() * eigen.vectors.transpose();
}

Eigen::Matrix3d rootOfInverse(const Eigen::Matrix3d& covariance) { return rootOf(covariance); }

Matrix9d rootOfInverse(const Matrix9d& covariance) { return rootOf(covariance); }

Matrix15d rootOfInverse(const Matrix15d& covariance) { return rootOf(covariance); }
}  // namespace scanloom
