#include "estimation/graph/internal/LinearFactor.h"

#include "base/core/Decompositions.h"
#include "estimation/graph/PosePriorFactor.h"
#include "estimation/graph/checkFactor.h"

#include <Eigen/QR>

namespace scanloom::linear_factor_unittest
{
namespace
{
LinearFactor randomFactor(std::vector<std::size_t> states, Noise& random)
{
  LinearFactor f{states, Eigen::MatrixXd(15, 15 * static_cast<Eigen::Index>(states.size())), random.normal<15>(1)};
  for (auto column : f.jacobian.colwise()) column = random.normal<15>(1);
  return f;
}

/** A prior, motions between neighbours, and a measurement of each state. */
std::vector<LinearFactor> randomChain(std::size_t states, Noise& random)
{
  std::vector<LinearFactor> chain{randomFactor({0}, random)};
  for (std::size_t k = 0; k + 1 < states; ++k)
  {
    chain.push_back(randomFactor({k, k + 1}, random));
    chain.push_back(randomFactor({k + 1}, random));
  }
  return chain;
}

struct NormalEquations
{
  Eigen::MatrixXd information;
  Eigen::VectorXd right;
};

NormalEquations normalEquationsOf(const std::vector<LinearFactor>& factors, std::size_t states)
{
  const auto size = 15 * static_cast<Eigen::Index>(states);
  NormalEquations n{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  for (const LinearFactor& f : factors)
  {
    Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(f.residual.size(), size);
    for (std::size_t k = 0; k < f.states.size(); ++k)
      wide.middleCols<15>(15 * static_cast<Eigen::Index>(f.states[k])) =
          f.jacobian.middleCols<15>(15 * static_cast<Eigen::Index>(k));
    n.information += wide.transpose() * wide;
    n.right -= wide.transpose() * f.residual;
  }
  return n;
}
}  // namespace

TEST(LinearFactor, eliminationIsTheSchurComplementOfTheNormalEquations)
{
  Noise random(1);
  const std::vector<LinearFactor> factors{randomFactor({0}, random), randomFactor({0, 1}, random),
                                          randomFactor({2, 0}, random)};
  const LinearFactor left = eliminate(factors, 0);
  EXPECT_EQ(left.states, (std::vector<std::size_t>{1, 2}));
  EXPECT_LE(left.jacobian.rows(), left.jacobian.cols());

  const NormalEquations n = normalEquationsOf(factors, 3);
  const Eigen::MatrixXd gain = n.information.bottomLeftCorner(30, 15) * n.information.topLeftCorner(15, 15).inverse();
  const Eigen::MatrixXd information =
      n.information.bottomRightCorner(30, 30) - gain * n.information.topRightCorner(15, 30);
  const Eigen::VectorXd right = n.right.tail(30) - gain * n.right.head(15);
  EXPECT_LT((left.jacobian.transpose() * left.jacobian - information).norm() / information.norm(), 1e-12);
  EXPECT_LT((left.jacobian.transpose() * left.residual + right).norm() / right.norm(), 1e-12);
}

TEST(LinearFactor, aChainForgottenStateByStateHasTheSolutionOfTheBatch)
{
  Noise random(2);
  constexpr std::size_t kStates = 20;
  std::vector<LinearFactor> chain = randomChain(kStates, random);
  const NormalEquations batch = normalEquationsOf(chain, kStates);
  const Eigen::VectorXd solution = solveSymmetric(batch.information, batch.right);
  const Matrix15d covariance = batch.information.inverse().bottomRightCorner<15, 15>();
  EXPECT_LT((marginalCovariance(chain, {kStates - 1}) - covariance).norm() / covariance.norm(), 1e-9);

  for (std::size_t state = 0; state + 1 < kStates; ++state)
  {
    std::vector<LinearFactor> leaving, rest;
    for (LinearFactor& f : chain) (f.touches(state) ? leaving : rest).push_back(std::move(f));
    rest.push_back(eliminate(leaving, state));
    chain = std::move(rest);
  }
  NormalEquations last = normalEquationsOf(chain, kStates);
  const Vector15d newest = solveSymmetric(last.information.bottomRightCorner<15, 15>(), last.right.tail<15>());
  EXPECT_LT((newest - solution.tail<15>()).norm() / solution.tail<15>().norm(), 1e-9);
}

TEST(LinearFactor, eliminatesAStateThatIsNotFullyDetermined)
{
  // State 0 is tied to state 1 in five directions, and measured by nothing else: nothing is learnt about state 1.
  Noise random(3);
  LinearFactor tie = randomFactor({0, 1}, random);
  tie.jacobian = tie.jacobian.topRows(5).eval();
  tie.residual = tie.residual.head(5).eval();
  const LinearFactor left = eliminate({tie}, 0);
  EXPECT_EQ(left.jacobian.rows(), 0);
  EXPECT_EQ(left.states, std::vector<std::size_t>{1});
}

TEST(LinearFactor, weighsARobustFactorDown)
{
  const NavState state = AnalyticDrive{}.stateAt(Timestamp{1s});
  NavState off = state;
  off.map_T_imu.translation.x() += 8;
  std::vector<StateBlocks> window{blocksOf(off)};
  const auto normOf = [&](double huber)
  {
    const Factor factor{
        std::make_unique<PosePriorFactor>(state.map_T_imu, Matrix6d::Identity(), Rigid::identity()), {0}, huber};
    return linearise(factor, window).residual.norm();
  };
  EXPECT_NEAR(normOf(0), 8, 1e-9);
  EXPECT_NEAR(normOf(10), 8, 1e-9);
  EXPECT_NEAR(normOf(2), std::sqrt(2 * 8), 1e-9);  // Huber's gradient is that of a residual of 2
}
}  // namespace scanloom::linear_factor_unittest
