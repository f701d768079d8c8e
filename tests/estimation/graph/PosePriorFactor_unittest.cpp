#include "estimation/graph/PosePriorFactor.h"

#include "estimation/graph/checkFactor.h"

namespace scanloom::pose_prior_factor_unittest
{
namespace
{
const NavState kState = AnalyticDrive{}.stateAt(Timestamp{2s});

Rigid bodyOf(const NavState& state) { return state.map_T_imu * kBodyFromImu.inverse(); }
}  // namespace

TEST(PosePriorFactor, jacobianEqualsCentralDifferences)
{
  Matrix6d information = Matrix6d::Identity();
  information(0, 4) = information(4, 0) = 0.5;
  checkFactor(std::make_unique<PosePriorFactor>(bodyOf(kState), information, kBodyFromImu),
              {disturbed(kState, 0.5, 1)});
}

TEST(PosePriorFactor, measuresTheBodyWhereTheStateHoldsTheImu)
{
  const PosePriorFactor factor(bodyOf(kState), Matrix6d::Identity(), kBodyFromImu);
  EXPECT_LT(residualOf(factor, {kState}).norm(), 1e-14);

  Vector6d step;
  step << 0.1, 0.2, -0.3, 0.02, -0.01, 0.03;
  NavState moved = kState;
  moved.map_T_imu = boxPlus(bodyOf(kState), step) * kBodyFromImu;
  EXPECT_NEAR(residualOf(factor, {moved}).norm(), step.norm(), 1e-12);
}

TEST(PosePriorFactor, saysNothingInDirectionsWithoutInformation)
{
  Matrix6d information = Matrix6d::Zero();
  information(1, 1) = 100;  // only the body's y
  const PosePriorFactor factor(bodyOf(kState), information, kBodyFromImu);
  const auto residualAfter = [&](int direction)
  {
    NavState moved = kState;
    moved.map_T_imu = boxPlus(bodyOf(kState), Vector6d(0.3 * Vector6d::Unit(direction))) * kBodyFromImu;
    return residualOf(factor, {moved}).norm();
  };
  EXPECT_NEAR(residualAfter(1), 3, 1e-12);
  for (const int direction : {0, 2, 3, 4, 5}) EXPECT_LT(residualAfter(direction), 1e-12);
}

TEST(PosePriorFactor, takesSlightlyNegativeEigenvaluesForZero)
{
  Matrix6d information = Matrix6d::Identity();
  information(2, 2) = -1e-9;
  NavState moved = kState;
  moved.map_T_imu = boxPlus(bodyOf(kState), Vector6d(5 * Vector6d::Unit(2))) * kBodyFromImu;
  EXPECT_LT(residualOf(PosePriorFactor(bodyOf(kState), information, kBodyFromImu), {moved}).norm(), 1e-12);
}
}  // namespace scanloom::pose_prior_factor_unittest
