#pragma once
#include "estimation/graph/StateBlocks.h"

#include <ceres/cost_function.h>

#include <vector>

namespace scanloom
{
/**
 * Information about some states from all measurements that have left the window, as whitened linear equations at a
 * fixed point: residual + jacobian * boxMinus(states, at).
 */
struct MarginalPrior
{
  std::vector<NavState> at;  // the linearisation point
  Eigen::MatrixXd jacobian;  // rows x 15 states
  Eigen::VectorXd residual;
};

/** The prior of a state with this covariance (tangent of boxPlus at it, positive definite). */
MarginalPrior priorOf(const NavState&, const Matrix15d& covariance);

/** Blocks: pose and motion of each state in turn. The prior must outlive the factor. */
class MarginalFactor final : public ceres::CostFunction
{
 public:
  explicit MarginalFactor(const MarginalPrior&);
  explicit MarginalFactor(MarginalPrior&&) = delete;

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  const MarginalPrior& prior_;
};
}  // namespace scanloom
