#include "ndt/GaussianCell.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

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

Eigen::Matrix3d assumedCovariance(const Eigen::Matrix3d& covariance, std::int64_t points)
{
  constexpr double kDeviation = 0.08;  // m
  const double n = static_cast<double>(points);
  return ((n - 1) * covariance + kDeviation * kDeviation * Eigen::Matrix3d::Identity()) / n;
}
}  // namespace

Moments Moments::about(const Eigen::Matrix<std::int64_t, 3, 1>& corner) const
{
  const std::int64_t dx = corner.x(), dy = corner.y(), dz = corner.z();
  Moments m;
  m.n = n;
  m.x = x + n * dx, m.y = y + n * dy, m.z = z + n * dz;
  m.xx = xx + 2 * dx * x + n * dx * dx;
  m.yy = yy + 2 * dy * y + n * dy * dy;
  m.zz = zz + 2 * dz * z + n * dz * dz;
  m.xy = xy + dx * y + dy * x + n * dx * dy;
  m.xz = xz + dx * z + dz * x + n * dx * dz;
  m.yz = yz + dy * z + dz * y + n * dy * dz;
  return m;
}

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

MeanAndCovariance meanAndCovariance(const Moments& m, const Eigen::Vector3d& corner)
{
  const double n = static_cast<double>(m.n);
  const Eigen::Vector3d mean =
      Eigen::Vector3d(static_cast<double>(m.x), static_cast<double>(m.y), static_cast<double>(m.z)) / n;
  Eigen::Matrix3d products;
  products << static_cast<double>(m.xx), static_cast<double>(m.xy), static_cast<double>(m.xz),  //
      static_cast<double>(m.xy), static_cast<double>(m.yy), static_cast<double>(m.yz),          //
      static_cast<double>(m.xz), static_cast<double>(m.yz), static_cast<double>(m.zz);
  const double freedom = std::max(1.0, n - 1);
  return {corner + Moments::kQuantum * mean,
          (products - n * mean * mean.transpose()) * (Moments::kQuantum * Moments::kQuantum / freedom)};
}

GaussianCell gaussianOf(const Moments& m, const Eigen::Vector3d& corner, double edge, double min_deviation)
{
  const auto [mean, seen] = meanAndCovariance(m, corner);
  const Eigen::Matrix3d covariance = m.n < GaussianCell::kMinPointsForCovariance ? assumedCovariance(seen, m.n) : seen;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(covariance);
  const Eigen::Array3d variances = eigen.eigenvalues().array().max(min_deviation * min_deviation);
  const Eigen::Vector3d missing = variances - eigen.eigenvalues().array();
  const Eigen::Vector3d thin = (1 - variances / (edge * edge / 12)).max(0.0).sqrt();
  const auto along = [&](const Eigen::Vector3d& v) -> Eigen::Matrix3d
  { return eigen.eigenvectors() * v.asDiagonal() * eigen.eigenvectors().transpose(); };
  return {mean, covariance + along(missing), static_cast<std::uint32_t>(m.n), along(thin)};
}
}  // namespace scanloom
