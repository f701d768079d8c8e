#pragma once
#include "estimation/graph/internal/PoseManifold.h"

#include <ceres/sized_cost_function.h>

namespace scanloom
{
/**
 * A measured pose of the body at one state relative to the body at another state; both are estimated. Six whitened
 * residuals boxMinus(reference_T_body of the states, measured). Blocks: pose of the reference state, pose of the state.
 */
class RelativePoseFactor final : public ceres::SizedCostFunction<6, 7, 7>
{
 public:
  /** The information's tangent is that of boxPlus at reference_T_body; it may be singular. */
  RelativePoseFactor(const Rigid& reference_T_body, const Matrix6d& information, const Rigid& body_T_imu);

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  Rigid reference_T_body_;
  Rigid imu_T_body_;
  Matrix6d root_;  // of the information
};
}  // namespace scanloom
