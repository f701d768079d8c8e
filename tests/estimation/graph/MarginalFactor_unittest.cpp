#include "estimation/graph/internal/MarginalFactor.h"

#include "estimation/graph/checkFactor.h"

namespace scanloom::marginal_factor_unittest
{
namespace
{
const AnalyticDrive kDrive;
const NavState kFirst = kDrive.stateAt(Timestamp{2s}), kSecond = kDrive.stateAt(Timestamp{3s});
}  // namespace

TEST(MarginalFactor, jacobianEqualsCentralDifferencesAwayFromItsLinearisationPoint)
{
  Noise random(1);
  MarginalPrior prior{{kFirst, kSecond}, Eigen::MatrixXd(20, 30), random.normal<20>(1)};
  for (auto column : prior.jacobian.colwise()) column = random.normal<20>(1);
  checkFactor(std::make_unique<MarginalFactor>(prior), {disturbed(kFirst, 0.3, 2), disturbed(kSecond, 0.3, 3)});
}

TEST(MarginalFactor, ofAFirstStateCountsStandardDeviations)
{
  Vector15d sigma;
  sigma << 0.1, 0.1, 0.1, 0.02, 0.02, 0.02, 1, 1, 1, 1e-3, 1e-3, 1e-3, 0.05, 0.05, 0.05;
  const MarginalPrior prior = priorOf(kFirst, sigma.cwiseAbs2().asDiagonal());
  const MarginalFactor factor(prior);
  EXPECT_EQ(residualOf(factor, {kFirst}).norm(), 0);
  for (int k = 0; k < 15; ++k)
    EXPECT_NEAR(residualOf(factor, {boxPlus(kFirst, 2 * sigma[k] * Vector15d::Unit(k))}).norm(), 2, 1e-9) << k;
}
}  // namespace scanloom::marginal_factor_unittest
