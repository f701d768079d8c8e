#include "ndt/GaussianCell.h"

#include <Eigen/Eigenvalues>

namespace scanloom
{
namespace
{
template <typename Operation>
void forEachSum(Moments& a, const Moments& b, Operation&& apply)
{
  apply(a.n, b.n);
  apply(a.x, b.x), apply(a.y, b.y), apply(a.z, b.z);
  apply(a.xx, b.xx), apply(a.xy, b.xy), apply(a.xz, b.xz);
  apply(a.yy, b.yy), apply(a.yz, b.yz), apply(a.zz, b.zz);
}

Eigen::Matrix3d withFlooredEigenvalues(const Eigen::Matrix3d& covariance, double floor)
{
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(covariance);
  const Eigen::Vector3d missing = (floor - eigen.eigenvalues().array()).max(0.0);
  return covariance + eigen.eigenvectors() * missing.asDiagonal() * eigen.eigenvectors().transpose();
}
}  // namespace

Moments& Moments::operator+=(const Moments& other)
{
  forEachSum(*this, other, [](std::int64_t& a, std::int64_t b) { a += b; });
  return *this;
}

Moments& Moments::operator-=(const Moments& other)
{
  forEachSum(*this, other, [](std::int64_t& a, std::int64_t b) { a -= b; });
  return *this;
}

GaussianCell gaussianOf(const Moments& m, const Eigen::Vector3d& corner, double min_deviation)
{
  const double n = static_cast<double>(m.n);
  const Eigen::Vector3d mean =
      Eigen::Vector3d(static_cast<double>(m.x), static_cast<double>(m.y), static_cast<double>(m.z)) / n;
  Eigen::Matrix3d products;
  products << static_cast<double>(m.xx), static_cast<double>(m.xy), static_cast<double>(m.xz),  //
      static_cast<double>(m.xy), static_cast<double>(m.yy), static_cast<double>(m.yz),          //
      static_cast<double>(m.xz), static_cast<double>(m.yz), static_cast<double>(m.zz);
  const Eigen::Matrix3d covariance =
      (products - n * mean * mean.transpose()) * (Moments::kQuantum * Moments::kQuantum / (n - 1));

  return {corner + Moments::kQuantum * mean, withFlooredEigenvalues(covariance, min_deviation * min_deviation),
          static_cast<std::uint32_t>(m.n)};
}
}  // namespace scanloom
