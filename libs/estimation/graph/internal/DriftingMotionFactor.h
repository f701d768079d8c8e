#pragma once
#include "estimation/graph/internal/PoseManifold.h"

#include <ceres/sized_cost_function.h>

namespace scanloom
{
/**
 * A pose relative to another one, measured by an odometry that errs alike all the time: in truth the motion is longer
 * than measured by a share of its length, and goes up by another share. Six whitened residuals
 * boxMinus(from_T_to of the poses, corrected measurement). Blocks: pose `from`, pose `to`, the two shares.
 */
class DriftingMotionFactor final : public ceres::SizedCostFunction<6, 7, 7, 2>
{
 public:
  /** `from_up`: which way is up in the frame `from`. The information's tangent is that of boxPlus at from_T_to. */
  DriftingMotionFactor(const Rigid& from_T_to, const Eigen::Vector3d& from_up, const Matrix6d& information);

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  Rigid from_T_to_;
  Eigen::Matrix<double, 3, 2> by_shares_;  // m: derivative of the translation
  Matrix6d root_;                          // of the information
};
}  // namespace scanloom
