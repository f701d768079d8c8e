/** Square roots S with S'S = information: S times a residual is a residual in standard deviations. */
#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace scanloom
{
/** Of a symmetric information matrix that may be singular; eigenvalues below zero by rounding count as zero. */
template <int N>
Eigen::Matrix<double, N, N> rootOfInformation(const Eigen::Matrix<double, N, N>& information)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen(
      Eigen::Matrix<double, N, N>(0.5 * (information + information.transpose())));
  return eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * eigen.eigenvectors().transpose();
}

/** Of the inverse of a positive definite covariance; not finite if it is not. */
template <int N>
Eigen::Matrix<double, N, N> rootOfInverse(const Eigen::Matrix<double, N, N>& covariance)
{
  const Eigen::Matrix<double, N, N> lower = covariance.llt().matrixL();
  return lower.template triangularView<Eigen::Lower>().solve(Eigen::Matrix<double, N, N>::Identity());
}
}  // namespace scanloom
