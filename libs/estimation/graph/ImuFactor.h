#pragma once
#include "estimation/graph/StateBlocks.h"
#include "estimation/imu/Preintegration.h"

#include <ceres/sized_cost_function.h>

namespace scanloom
{
/**
 * A preintegrated motion between two states: nine residuals, eq. (45) of Forster 2017, with the bias of the first state
 * corrected to first order, and six of the random walk of the biases, eq. (48); whitened.
 * Blocks: pose and motion of the first state, pose and motion of the second.
 */
class ImuFactor final : public ceres::SizedCostFunction<15, 7, 9, 7, 9>
{
 public:
  /** The motion must outlive the factor. */
  ImuFactor(const Preintegration& motion, const ImuNoise&);
  ImuFactor(Preintegration&&, const ImuNoise&) = delete;

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  const Preintegration& motion_;
  Matrix15d root_;  // of the information
};
}  // namespace scanloom
