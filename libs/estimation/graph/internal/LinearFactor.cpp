#include "estimation/graph/internal/LinearFactor.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Index columnsOf(std::size_t states) { return static_cast<Eigen::Index>(states) * kStateSize; }

/** All equations below each other, with columns in the order of `states` and the residual last. */
Eigen::MatrixXd stacked(const std::vector<LinearFactor>& factors, const std::vector<std::size_t>& states)
{
  Eigen::Index rows = 0;
  for (const LinearFactor& f : factors) rows += f.residual.size();

  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows, columnsOf(states.size()) + 1);
  Eigen::Index row = 0;
  for (const LinearFactor& f : factors)
  {
    for (std::size_t k = 0; k < f.states.size(); ++k)
    {
      const auto place = std::find(states.begin(), states.end(), f.states[k]) - states.begin();
      all.block(row, place * kStateSize, f.residual.size(), kStateSize) =
          f.jacobian.middleCols<kStateSize>(columnsOf(k));
    }
    all.col(all.cols() - 1).segment(row, f.residual.size()) = f.residual;
    row += f.residual.size();
  }
  return all;
}

/** Equivalent equations with at most one row per column; the cost changes by a constant. */
Eigen::MatrixXd compressed(const Eigen::MatrixXd& equations)
{
  if (equations.rows() < equations.cols()) return equations;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(equations);
  return qr.matrixQR().topRows(equations.cols() - 1).triangularView<Eigen::Upper>();
}

std::vector<std::size_t> statesOf(const std::vector<LinearFactor>& factors)
{
  std::vector<std::size_t> states;
  for (const LinearFactor& f : factors) states.insert(states.end(), f.states.begin(), f.states.end());
  std::sort(states.begin(), states.end());
  states.erase(std::unique(states.begin(), states.end()), states.end());
  return states;
}
}  // namespace

std::vector<double*> parametersOf(const Factor& factor, std::vector<StateBlocks>& window)
{
  // A pose block begins the next state; a motion block belongs to the state of the pose block before it.
  std::vector<double*> parameters;
  auto state = factor.states.begin();
  for (const int size : factor.cost->parameter_block_sizes())
  {
    const bool is_pose = size == PoseBlock::RowsAtCompileTime;
    if (is_pose && !parameters.empty()) ++state;
    parameters.push_back(is_pose ? window[*state].pose.data() : window[*state].motion.data());
  }
  return parameters;
}

bool LinearFactor::touches(std::size_t state) const
{
  return std::find(states.begin(), states.end(), state) != states.end();
}

LinearFactor linearise(const Factor& factor, std::vector<StateBlocks>& window)
{
  const std::vector<double*> parameters = parametersOf(factor, window);
  const std::vector<int>& sizes = factor.cost->parameter_block_sizes();
  const int rows = factor.cost->num_residuals();
  std::vector<RowMajorMatrix> by_block;
  std::vector<double*> jacobians;
  for (const int size : sizes) by_block.emplace_back(rows, size);
  for (RowMajorMatrix& j : by_block) jacobians.push_back(j.data());

  LinearFactor linear{factor.states, Eigen::MatrixXd::Zero(rows, columnsOf(factor.states.size())),
                      Eigen::VectorXd(rows)};
  factor.cost->Evaluate(parameters.data(), linear.residual.data(), jacobians.data());

  Eigen::Index column = -kStateSize;
  for (std::size_t k = 0; k < sizes.size(); ++k)
  {
    const bool is_pose = sizes[k] == PoseBlock::RowsAtCompileTime;
    if (is_pose) column += kStateSize;
    if (is_pose)
      linear.jacobian.middleCols<kPoseSize>(column) = by_block[k] * PoseManifold::plusJacobian(poseOf(parameters[k]));
    else
      linear.jacobian.middleCols<kMotionSize>(column + kPoseSize) = by_block[k];
  }

  const double norm = linear.residual.norm();
  if (factor.huber > 0 && norm > factor.huber)
  {
    const double weight = std::sqrt(factor.huber / norm);
    linear.jacobian *= weight;
    linear.residual *= weight;
  }
  return linear;
}

LinearFactor combined(const std::vector<LinearFactor>& factors)
{
  const std::vector<std::size_t> states = statesOf(factors);
  const Eigen::MatrixXd equations = compressed(stacked(factors, states));
  return {states, equations.leftCols(equations.cols() - 1), equations.col(equations.cols() - 1)};
}

LinearFactor loosened(LinearFactor factor, std::size_t state, const Matrix6d& step)
{
  // The step s leaves residual + J s, which has the covariance I + J S J^T.
  const auto place =
      static_cast<std::size_t>(std::find(factor.states.begin(), factor.states.end(), state) - factor.states.begin());
  const auto by_pose = factor.jacobian.middleCols<kPoseSize>(columnsOf(place));
  Eigen::MatrixXd covariance = by_pose * step * by_pose.transpose();
  covariance.diagonal().array() += 1;
  // Divided by the root of that, the residual is in standard deviations again.
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  root.matrixL().solveInPlace(factor.jacobian);
  root.matrixL().solveInPlace(factor.residual);
  return factor;
}

LinearFactor eliminate(const std::vector<LinearFactor>& factors, std::size_t state)
{
  std::vector<std::size_t> others = statesOf(factors);
  others.erase(std::remove(others.begin(), others.end(), state), others.end());
  std::vector<std::size_t> order{state};
  order.insert(order.end(), others.begin(), others.end());
  const Eigen::MatrixXd equations = stacked(factors, order);

  // Columns of equal length, so that the rank does not depend on the units.
  Eigen::MatrixXd leaving = equations.leftCols<kStateSize>();
  for (auto column : leaving.colwise()) column /= std::max(column.norm(), 1e-300);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(leaving);
  const Eigen::MatrixXd turned = qr.householderQ().adjoint() * equations.rightCols(equations.cols() - kStateSize);

  // The leaving state can satisfy the first rows for any values of the others: they hold no information about them.
  const Eigen::MatrixXd left = compressed(turned.bottomRows(turned.rows() - qr.rank()));
  return {others, left.leftCols(left.cols() - 1), left.col(left.cols() - 1)};
}

Eigen::MatrixXd marginalCovariance(const std::vector<LinearFactor>& factors, const std::vector<std::size_t>& kept)
{
  const std::vector<std::size_t> states = statesOf(factors);
  const auto columnOf = [&](std::size_t state) {
    return columnsOf(static_cast<std::size_t>(std::lower_bound(states.begin(), states.end(), state) - states.begin()));
  };

  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(columnsOf(states.size()), columnsOf(states.size()));
  for (const LinearFactor& f : factors)
    for (std::size_t i = 0; i < f.states.size(); ++i)
      for (std::size_t j = 0; j < f.states.size(); ++j)
        information.block<kStateSize, kStateSize>(columnOf(f.states[i]), columnOf(f.states[j])).noalias() +=
            f.jacobian.middleCols<kStateSize>(columnsOf(i)).transpose() *
            f.jacobian.middleCols<kStateSize>(columnsOf(j));

  // Scaled to a unit diagonal, so that different units cost no digits.
  const Eigen::VectorXd scale = information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> solver(scale.asDiagonal() * information * scale.asDiagonal());
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(information.rows(), columnsOf(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k)
    wanted.block<kStateSize, kStateSize>(columnOf(kept[k]), columnsOf(k)).setIdentity();
  // Half of the inverse: the product with its transpose is symmetric to the last bit.
  const Eigen::MatrixXd half = solver.matrixL().solve(scale.asDiagonal() * wanted);
  return half.transpose() * half;
}
}  // namespace scanloom
