#include "estimation/graph/internal/RelativePoseFactor.h"

#include "estimation/graph/PosePriorFactor.h"
#include "estimation/graph/checkFactor.h"

namespace scanloom::relative_pose_factor_unittest
{
namespace
{
const NavState kReference = AnalyticDrive{}.stateAt(Timestamp{2s});
const NavState kState = AnalyticDrive{}.stateAt(Timestamp{3s});

Rigid bodyOf(const NavState& state) { return state.map_T_imu * kBodyFromImu.inverse(); }
const Rigid kMeasured = bodyOf(kReference).inverse() * bodyOf(kState);
}  // namespace

TEST(RelativePoseFactor, jacobianEqualsCentralDifferences)
{
  Matrix6d information = Matrix6d::Identity();
  information(0, 4) = information(4, 0) = 0.5;
  checkFactor(std::make_unique<RelativePoseFactor>(kMeasured, information, kBodyFromImu),
              {disturbed(kReference, 0.3, 1), disturbed(kState, 0.3, 2)});
}

TEST(RelativePoseFactor, doesNotSeeACommonMoveOfBothStates)
{
  const Rigid move = Rigid::fromXyzYawPitchRoll(5, -3, 1, 2, 0.3, -0.4);
  NavState reference = kReference, state = kState;
  reference.map_T_imu = move * reference.map_T_imu;
  state.map_T_imu = move * state.map_T_imu;
  EXPECT_LT(residualOf(RelativePoseFactor(kMeasured, Matrix6d::Identity(), kBodyFromImu), {reference, state}).norm(),
            1e-13);
}

TEST(RelativePoseFactor, toAFixedReferenceIsAPosePrior)
{
  Matrix6d information = Matrix6d::Identity();
  information.diagonal() << 1, 4, 9, 16, 25, 36;
  const NavState off = disturbed(kState, 0.3, 5);
  const Eigen::VectorXd relative =
      residualOf(RelativePoseFactor(kMeasured, information, kBodyFromImu), {kReference, off});
  const Eigen::VectorXd absolute =
      residualOf(PosePriorFactor(bodyOf(kReference) * kMeasured, information, kBodyFromImu), {off});
  EXPECT_LT((relative - absolute).norm(), 1e-12);
}
}  // namespace scanloom::relative_pose_factor_unittest
