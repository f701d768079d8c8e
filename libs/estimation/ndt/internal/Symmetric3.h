/** Symmetric 3x3 matrices as six numbers, and sums of 6x6 matrices made of them, with half of Eigen's operations. */
#pragma once
#include "base/core/Rigid.h"

#include <Eigen/Core>

namespace scanloom
{
/** T: a number, or a vector of numbers. */
template <typename T>
struct SymmetricOf
{
  T xx, xy, xz, yy, yz, zz;
};
using Symmetric3 = SymmetricOf<double>;

/** A B A. */
template <typename T>
[[gnu::always_inline]] inline SymmetricOf<T> sandwich(const SymmetricOf<T>& a, const SymmetricOf<T>& b)
{
  const T xx = a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, xy = a.xx * b.xy + a.xy * b.yy + a.xz * b.yz,
          xz = a.xx * b.xz + a.xy * b.yz + a.xz * b.zz;
  const T yx = a.xy * b.xx + a.yy * b.xy + a.yz * b.xz, yy = a.xy * b.xy + a.yy * b.yy + a.yz * b.yz,
          yz = a.xy * b.xz + a.yy * b.yz + a.yz * b.zz;
  const T zx = a.xz * b.xx + a.yz * b.xy + a.zz * b.xz, zy = a.xz * b.xy + a.yz * b.yy + a.zz * b.yz,
          zz = a.xz * b.xz + a.yz * b.yz + a.zz * b.zz;
  return {xx * a.xx + xy * a.xy + xz * a.xz, xx * a.xy + xy * a.yy + xz * a.yz, xx * a.xz + xy * a.yz + xz * a.zz,
          yx * a.xy + yy * a.yy + yz * a.yz, yx * a.xz + yy * a.yz + yz * a.zz, zx * a.xz + zy * a.yz + zz * a.zz};
}

/** R m R'. */
inline Symmetric3 turned(const Eigen::Matrix3d& m, const Eigen::Matrix3d& r)
{
  const Eigen::Matrix3d half = r * m;
  const auto entry = [&](int i, int j) { return half(i, 0) * r(j, 0) + half(i, 1) * r(j, 1) + half(i, 2) * r(j, 2); };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

inline Eigen::Matrix3d matrixOf(const Symmetric3& m)
{
  Eigen::Matrix3d full;
  full << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return full;
}

inline Symmetric3 scaled(const Symmetric3& m, double by)
{
  return {by * m.xx, by * m.xy, by * m.xz, by * m.yy, by * m.yz, by * m.zz};
}

/** Sum of J' A J with J = [I, -skew(v)], the derivative of a point at v by a step of the pose. */
class PoseSum
{
 public:
  void add(const Symmetric3& a, double x, double y, double z)
  {
    // A skew(v), row by row.
    const double xx = a.xy * z - a.xz * y, xy = a.xz * x - a.xx * z, xz = a.xx * y - a.xy * x;
    const double yx = a.yy * z - a.yz * y, yy = a.yz * x - a.xy * z, yz = a.xy * y - a.yy * x;
    const double zx = a.yz * z - a.zz * y, zy = a.zz * x - a.xz * z, zz = a.xz * y - a.yz * x;
    moved_.xx += a.xx, moved_.xy += a.xy, moved_.xz += a.xz;
    moved_.yy += a.yy, moved_.yz += a.yz, moved_.zz += a.zz;
    mixed_[0] += xx, mixed_[1] += xy, mixed_[2] += xz;
    mixed_[3] += yx, mixed_[4] += yy, mixed_[5] += yz;
    mixed_[6] += zx, mixed_[7] += zy, mixed_[8] += zz;
    turned_.xx += z * yx - y * zx;
    turned_.xy += z * yy - y * zy;
    turned_.xz += z * yz - y * zz;
    turned_.yy += x * zy - z * xy;
    turned_.yz += x * zz - z * xz;
    turned_.zz += y * xz - x * yz;
  }

  Matrix6d matrix() const
  {
    Eigen::Matrix3d mixed;
    mixed << mixed_[0], mixed_[1], mixed_[2], mixed_[3], mixed_[4], mixed_[5], mixed_[6], mixed_[7], mixed_[8];
    Matrix6d m;
    m << matrixOf(moved_), -mixed, -mixed.transpose(), matrixOf(turned_);
    return m;
  }

 private:
  Symmetric3 moved_{}, turned_{};
  double mixed_[9] = {};
};
}  // namespace scanloom
