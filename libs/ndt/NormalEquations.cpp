#include "ndt/NormalEquations.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kChunk = 256;  // source cells: fixed, so that sums do not depend on the number of threads

/** Symmetric 3x3 as six numbers: half the arithmetic of a full one. */
struct Symmetric
{
  double xx, xy, xz, yy, yz, zz;

  Vector3d operator*(const Vector3d& v) const
  {
    return {xx * v.x() + xy * v.y() + xz * v.z(), xy * v.x() + yy * v.y() + yz * v.z(),
            xz * v.x() + yz * v.y() + zz * v.z()};
  }
  void add(double w, const Symmetric& s)
  {
    xx += w * s.xx, xy += w * s.xy, xz += w * s.xz;
    yy += w * s.yy, yz += w * s.yz, zz += w * s.zz;
  }
  Matrix3d full() const
  {
    Matrix3d m;
    m << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return m;
  }
};

Symmetric inverseOfSum(const Matrix3d& a, const Matrix3d& b)
{
  const double xx = a(0, 0) + b(0, 0), xy = a(0, 1) + b(0, 1), xz = a(0, 2) + b(0, 2);
  const double yy = a(1, 1) + b(1, 1), yz = a(1, 2) + b(1, 2), zz = a(2, 2) + b(2, 2);
  const double cxx = yy * zz - yz * yz, cxy = xz * yz - xy * zz, cxz = xy * yz - xz * yy;
  const double s = 1 / (xx * cxx + xy * cxy + xz * cxz);
  return {s * cxx, s * cxy, s * cxz, s * (xx * zz - xz * xz), s * (xy * xz - xx * yz), s * (xx * yy - xy * xy)};
}

/** The sums over the neighbours of one source cell, turned into the source's frame. */
struct CellSums
{
  double value = 0;                    // -sum e
  double best = 0;                     // largest e
  Vector3d force = Vector3d::Zero();   // sum w B m
  Matrix3d weight = Matrix3d::Zero();  // sum w B
};

CellSums sumOverNeighbours(const Neighbourhoods& all, std::size_t i, const Matrix3d& rotation,
                           const Vector3d& translation, double d2)
{
  const GaussianCell& source = all.source()[i];
  const Vector3d mean = rotation * source.mean + translation;
  const Matrix3d covariance = rotation * source.covariance * rotation.transpose();
  Symmetric weight{};
  CellSums sums;
  for (const std::uint32_t j : all.of(i))
  {
    const GaussianCell& target = all.target()[j];
    const Symmetric b = inverseOfSum(covariance, target.covariance);
    const Vector3d m = mean - target.mean;
    const Vector3d u = b * m;
    const double e = std::exp(-d2 / 2 * m.dot(u));
    const double w = d2 * e;
    sums.value -= e;
    sums.best = std::max(sums.best, e);
    sums.force += w * u;
    weight.add(w, b);
  }
  sums.force = rotation.transpose() * sums.force;
  sums.weight = rotation.transpose() * weight.full() * rotation;
  return sums;
}

/** J = [I, -skew(mu)] in the source's frame, so that J' A J needs no matrix product larger than 3x3. */
void addCell(const GaussianCell& source, const CellSums& sums, NormalEquations& equations)
{
  const Matrix3d mu = skew(source.mean);
  const Matrix3d weight_mu = sums.weight * mu;
  equations.curvature.topLeftCorner<3, 3>() += sums.weight;
  equations.curvature.topRightCorner<3, 3>() -= weight_mu;
  equations.curvature.bottomRightCorner<3, 3>() -= mu * weight_mu;

  equations.gradient.head<3>() += sums.force;
  equations.gradient.tail<3>() += source.mean.cross(sums.force);

  equations.value += sums.value;
  if (sums.best >= std::exp(-1.0)) equations.met_points += source.points;
}
}  // namespace

NormalEquations normalEquations(const Neighbourhoods& all, const Rigid& target_T_source, double d2)
{
  const Matrix3d rotation = target_T_source.rotation.toRotationMatrix();
  const std::size_t cells = all.source().size();
  NormalEquations total;
  for (std::size_t begin = 0; begin < cells; begin += kChunk)
  {
    NormalEquations chunk;
    for (std::size_t i = begin; i < std::min(begin + kChunk, cells); ++i)
      addCell(all.source()[i], sumOverNeighbours(all, i, rotation, target_T_source.translation, d2), chunk);
    total.value += chunk.value;
    total.gradient += chunk.gradient;
    total.curvature += chunk.curvature;
    total.met_points += chunk.met_points;
  }
  total.curvature.bottomLeftCorner<3, 3>() = total.curvature.topRightCorner<3, 3>().transpose();
  return total;
}
}  // namespace scanloom
