#pragma once
#include "estimation/graph/internal/LinearFactor.h"
#include "estimation/imu/AnalyticDrive.h"
#include "support/checkJacobian.h"

namespace scanloom
{
inline std::vector<StateBlocks> blocksOf(const std::vector<NavState>& states)
{
  std::vector<StateBlocks> blocks;
  for (const NavState& s : states) blocks.push_back(blocksOf(s));
  return blocks;
}

/** The whitened residual; the factor takes all the states, in their order. */
inline Eigen::VectorXd residualOf(const ceres::CostFunction& cost, const std::vector<NavState>& states)
{
  std::vector<StateBlocks> blocks = blocksOf(states);
  std::vector<double*> parameters;
  std::size_t state = 0;
  for (const int size : cost.parameter_block_sizes())
  {
    if (size == 7 && !parameters.empty()) ++state;
    parameters.push_back(size == 7 ? blocks[state].pose.data() : blocks[state].motion.data());
  }
  Eigen::VectorXd residual(cost.num_residuals());
  EXPECT_TRUE(cost.Evaluate(parameters.data(), residual.data(), nullptr));
  return residual;
}

/** The Jacobian that Ceres and marginalisation see, by steps of boxPlus(NavState), against central differences. */
inline void checkFactor(std::unique_ptr<ceres::CostFunction> cost, const std::vector<NavState>& states)
{
  const ceres::CostFunction& function = *cost;
  Factor factor{std::move(cost), {}};
  for (std::size_t k = 0; k < states.size(); ++k) factor.states.push_back(k);
  std::vector<StateBlocks> blocks = blocksOf(states);
  const LinearFactor linear = linearise(factor, blocks);

  EXPECT_LT((linear.residual - residualOf(function, states)).norm(), 1e-12);
  checkJacobian(linear.jacobian,
                [&](const Eigen::VectorXd& step) -> Eigen::VectorXd
                {
                  std::vector<NavState> moved = states;
                  for (std::size_t k = 0; k < states.size(); ++k)
                    moved[k] = boxPlus(states[k], step.segment<15>(15 * static_cast<Eigen::Index>(k)));
                  return residualOf(function, moved);
                });
}

/** A state of the drive, off by steps of `sigma`: residuals and the curvature of the Jacobians show. */
inline NavState disturbed(const NavState& state, double sigma, unsigned seed)
{
  return boxPlus(state, Noise(seed).normal<15>(sigma));
}
}  // namespace scanloom
