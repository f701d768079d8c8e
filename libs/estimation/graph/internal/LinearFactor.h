/** Factors linearised at the present values of the states, for marginalisation and covariances. */
#pragma once
#include "estimation/graph/StateBlocks.h"

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
  double huber = 0;  // above this norm of the residual the cost grows linearly; 0: never
};

/** The factor's blocks in the window, in the order of its cost function. */
std::vector<double*> parametersOf(const Factor&, std::vector<StateBlocks>& window);

/** Whitened equations jacobian * step + residual = 0 on the steps (boxPlus) of some states, 15 columns each. */
struct LinearFactor
{
  std::vector<std::size_t> states;
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd residual;

  bool touches(std::size_t state) const;
};

/** At the window's values; a robust factor with its weight there. */
LinearFactor linearise(const Factor&, std::vector<StateBlocks>& window);

/**
 * Marginalises `state` out: the equations for the other states when `state` takes its best value. This is the Schur
 * complement of the normal equations in square root form, by an orthogonal transform (N. Demmel, D. Schubert, C.
 * Sommer, D. Cremers, V. Usenko: Square Root Marginalization for Sliding-Window Bundle Adjustment, ICCV 2021), which
 * avoids the loss of digits by squaring. At most as many rows as columns are left.
 */
LinearFactor eliminate(const std::vector<LinearFactor>&, std::size_t state);

/** All equations in one; at most as many rows as columns. */
LinearFactor combined(const std::vector<LinearFactor>&);

/** The equations after the pose of `state`, one of theirs, has moved by an unknown step of covariance `step`. */
LinearFactor loosened(LinearFactor, std::size_t state, const Matrix6d& step);

/** Joint covariance of the states `kept`, in their order, given all the factors, which must determine them. */
Eigen::MatrixXd marginalCovariance(const std::vector<LinearFactor>&, const std::vector<std::size_t>& kept);
}  // namespace scanloom
