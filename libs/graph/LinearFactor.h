/** Factors made linear at the states' present values: what marginalisation and covariances are computed from. */
#pragma once
#include "graph/StateBlocks.h"

#include <ceres/cost_function.h>

#include <memory>
#include <vector>

namespace scanloom
{
/** A cost function and the states of the window (0 is the oldest) whose blocks it takes. */
struct Factor
{
  std::unique_ptr<ceres::CostFunction> cost;
  std::vector<std::size_t> states;
  double huber = 0;  // the norm of the residual from which it counts linearly; 0 never
};

/** The factor's blocks among the window's, in the order of its cost function. */
std::vector<double*> parametersOf(const Factor&, std::vector<StateBlocks>& window);

/** Whitened equations jacobian * step + residual = 0 on the steps (boxPlus) of some states, 15 columns each. */
struct LinearFactor
{
  std::vector<std::size_t> states;
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd residual;

  bool touches(std::size_t state) const;
};

/** At the window's values; a robust factor with the weight that it has there. */
LinearFactor linearise(const Factor&, std::vector<StateBlocks>& window);

/**
 * The same equations without `state`: what they say about the other states when it takes its best value. This is the
 * Schur complement of the normal equations, taken in square root form by an orthogonal transform (N. Demmel, D.
 * Schubert, C. Sommer, D. Cremers, V. Usenko: Square Root Marginalization for Sliding-Window Bundle Adjustment, ICCV
 * 2021), which keeps the digits that squaring loses. At most as many rows as columns are left.
 */
LinearFactor eliminate(const std::vector<LinearFactor>&, std::size_t state);

/** Joint covariance of the states `kept`, in their order, given all the factors, which must determine them. */
Eigen::MatrixXd marginalCovariance(const std::vector<LinearFactor>&, const std::vector<std::size_t>& kept);
}  // namespace scanloom
