#include "base/core/Decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace scanloom
{
namespace
{
// Eigen's solver for any size gives the same bits as those for fixed sizes, and is compiled once for all.
using EigenSolver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
}  // namespace

Matrix6d congruent(const Matrix6d& m, const Matrix6d& j) { return j.transpose() * m * j; }

Matrix6d inverse(const Matrix6d& m) { return m.inverse(); }

Matrix6d solve(const Matrix6d& a, const Matrix6d& b) { return a.partialPivLu().solve(b); }

bool isPositiveDefinite(const Eigen::Ref<const Eigen::MatrixXd>& m)
{
  return m.allFinite() && m.llt().info() == Eigen::Success;
}

std::optional<Vector6d> solvePositive(const Matrix6d& a, const Vector6d& b)
{
  const Eigen::LLT<Matrix6d> solver(a);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return Vector6d(solver.solve(b));
}

Matrix6d inverseOfPositive(const Matrix6d& m) { return m.llt().solve(Matrix6d::Identity()); }

Eigen::VectorXd solveSymmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) { return a.ldlt().solve(b); }

Matrix6d informationWithError(const Matrix6d& information, const Matrix6d& error)
{
  const Matrix6d left = solve(Matrix6d::Identity() + information * error, information);
  return 0.5 * (left + left.transpose());
}

Eigensystem3 eigensystem3(const Eigen::Matrix3d& symmetric)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(symmetric);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigensystem6 eigensystem(const Matrix6d& symmetric)
{
  const EigenSolver eigen(symmetric);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigensystem7 eigensystem7(const Eigen::Matrix<double, 7, 7>& symmetric)
{
  const EigenSolver eigen(symmetric);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigensystem6 eigensystem(const Matrix6d& a, const Matrix6d& b)
{
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(a, b);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

LargestTrace rotationOfLargestTrace(const Eigen::Matrix3d& m)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d sign(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  return {svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose(), svd.singularValues().cwiseProduct(sign)};
}
}  // namespace scanloom
