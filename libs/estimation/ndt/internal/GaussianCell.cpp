#include "estimation/ndt/internal/GaussianCell.h"

#include "estimation/ndt/FittedConstants.h"
#include "estimation/ndt/internal/EigenLanes.h"

#include <algorithm>

namespace scanloom
{
namespace
{
Eigen::Vector3d meanInQuanta(const Moments& m)
{
  return Eigen::Vector3d(static_cast<double>(m.x), static_cast<double>(m.y), static_cast<double>(m.z)) /
         static_cast<double>(m.n);
}

Eigen::Matrix3d assumedCovariance(const Eigen::Matrix3d& covariance, std::int64_t points)
{
  const double n = static_cast<double>(points);
  return ((n - 1) * covariance +
          fitted::kSpreadOfFewPoints * fitted::kSpreadOfFewPoints * Eigen::Matrix3d::Identity()) /
         n;
}

/** With eigenvalues that are too small raised, and its structure. */
GaussianCell limited(GaussianCell cell, const EigenBlock& eigen, std::size_t lane, double edge, double min_deviation)
{
  const Eigen::Array3d seen = eigen.valuesOf(lane), variances = seen.max(min_deviation * min_deviation);
  const Eigen::Array3d thin = (1 - variances / (edge * edge / 12)).max(0.0).sqrt();
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d axis = eigen.vectorOf(static_cast<std::size_t>(i), lane);
    const Eigen::Matrix3d projector = axis * axis.transpose();
    cell.covariance += (variances[i] - seen[i]) * projector;
    cell.structure += thin[i] * projector;
  }
  return cell;
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

Moments& Moments::operator+=(const Moments& m)
{
  n += m.n, x += m.x, y += m.y, z += m.z;
  xx += m.xx, xy += m.xy, xz += m.xz, yy += m.yy, yz += m.yz, zz += m.zz;
  return *this;
}

Moments& Moments::operator-=(const Moments& m)
{
  n -= m.n, x -= m.x, y -= m.y, z -= m.z;
  xx -= m.xx, xy -= m.xy, xz -= m.xz, yy -= m.yy, yz -= m.yz, zz -= m.zz;
  return *this;
}

Eigen::Vector3d meanOf(const Moments& m, const Eigen::Vector3d& corner)
{
  return corner + Moments::kQuantum * meanInQuanta(m);
}

MeanAndCovariance meanAndCovariance(const Moments& m, const Eigen::Vector3d& corner)
{
  const double n = static_cast<double>(m.n);
  const Eigen::Vector3d mean = meanInQuanta(m);
  Eigen::Matrix3d products;
  products << static_cast<double>(m.xx), static_cast<double>(m.xy), static_cast<double>(m.xz),  //
      static_cast<double>(m.xy), static_cast<double>(m.yy), static_cast<double>(m.yz),          //
      static_cast<double>(m.xz), static_cast<double>(m.yz), static_cast<double>(m.zz);
  const double freedom = std::max(1.0, n - 1);
  return {corner + Moments::kQuantum * mean,
          (products - n * mean * mean.transpose()) * (Moments::kQuantum * Moments::kQuantum / freedom)};
}

std::array<GaussianCell, kGaussiansAtOnce> gaussiansOf(const CellPoints* cells, std::size_t count, double edge,
                                                       double min_deviation)
{
  std::array<GaussianCell, kGaussiansAtOnce> gaussians;
  SymmetricBlock covariances{};
  for (std::size_t i = 0; i < count; ++i)
  {
    const Moments& m = cells[i].moments;
    const auto [mean, seen] = meanAndCovariance(m, cells[i].corner);
    const bool few = m.n < GaussianCell::kMinPointsForCovariance;
    gaussians[i] = {mean, few ? assumedCovariance(seen, m.n) : seen, static_cast<std::uint32_t>(m.n)};
    covariances.set(i, gaussians[i].covariance);
  }
  const EigenBlock eigen = eigensystemsOf(covariances);
  for (std::size_t i = 0; i < count; ++i) gaussians[i] = limited(gaussians[i], eigen, i, edge, min_deviation);
  return gaussians;
}
}  // namespace scanloom
