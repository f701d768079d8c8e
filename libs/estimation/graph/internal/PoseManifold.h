/** Poses for Ceres: blocks of seven numbers that move in six directions, those of boxPlus. */
#pragma once
#include "base/core/Rigid.h"

#include <ceres/manifold.h>

namespace scanloom
{
using PoseBlock = Eigen::Matrix<double, 7, 1>;  // x y z qx qy qz qw

PoseBlock blockOf(const Rigid&);
Rigid poseOf(const double* block);

class PoseManifold final : public ceres::Manifold
{
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }

  bool Plus(const double* x, const double* step, double* x_plus_step) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;  // 7x6, row-major
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;  // 6x7, row-major

  static Eigen::Matrix<double, 7, 6> plusJacobian(const Rigid&);
  static Eigen::Matrix<double, 6, 7> minusJacobian(const Rigid&);
};

/** Derivative of boxMinus(boxPlus(to, step), from) by a small step; every pose residual needs it. */
Matrix6d boxMinusByStep(const Rigid& to, const Rigid& from);

/**
 * Writes the derivative of R residuals by the seven numbers of a pose block, as Ceres needs it, given the derivative by
 * a step. Multiplied by PlusJacobian it gives `by_step` again. Does nothing if out is null: Ceres did not ask for it.
 */
template <int R>
void writePoseJacobian(const Eigen::Matrix<double, R, 6>& by_step, const Rigid& pose, double* out)
{
  if (!out) return;
  Eigen::Map<Eigen::Matrix<double, R, 7, Eigen::RowMajor>>(out, by_step.rows(), 7) =
      by_step * PoseManifold::minusJacobian(pose);
}
}  // namespace scanloom
