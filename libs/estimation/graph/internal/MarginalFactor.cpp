#include "estimation/graph/internal/MarginalFactor.h"

#include "estimation/graph/internal/Whitening.h"

namespace scanloom
{
namespace
{
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
}

MarginalPrior priorOf(const NavState& state, const Matrix15d& covariance)
{
  return {{state}, rootOfInverse(covariance), Vector15d::Zero()};
}

MarginalFactor::MarginalFactor(const MarginalPrior& prior) : prior_(prior)
{
  set_num_residuals(static_cast<int>(prior.residual.size()));
  for (std::size_t k = 0; k < prior.at.size(); ++k)
  {
    mutable_parameter_block_sizes()->push_back(PoseBlock::RowsAtCompileTime);
    mutable_parameter_block_sizes()->push_back(MotionBlock::RowsAtCompileTime);
  }
}

bool MarginalFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const
{
  const auto rows = prior_.residual.size();
  Eigen::Map<Eigen::VectorXd> residual(residuals, rows);
  residual = prior_.residual;
  for (std::size_t k = 0; k < prior_.at.size(); ++k)
  {
    const NavState& at = prior_.at[k];
    const NavState state = stateOf(parameters[2 * k], parameters[2 * k + 1], at.stamp);
    const auto by_state = prior_.jacobian.middleCols<kStateSize>(static_cast<Eigen::Index>(k) * kStateSize);
    residual += by_state * boxMinus(state, at);
    if (!jacobians) continue;

    writePoseJacobian<Eigen::Dynamic>(by_state.leftCols<kPoseSize>() * boxMinusByStep(state.map_T_imu, at.map_T_imu),
                                      state.map_T_imu, jacobians[2 * k]);
    if (jacobians[2 * k + 1])
      Eigen::Map<RowMajorMatrix>(jacobians[2 * k + 1], rows, kMotionSize) = by_state.rightCols<kMotionSize>();
  }
  return true;
}
}  // namespace scanloom
