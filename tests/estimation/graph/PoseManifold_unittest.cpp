#include "estimation/graph/internal/PoseManifold.h"

#include "support/checkJacobian.h"

#include <ceres/manifold_test_utils.h>

namespace scanloom::pose_manifold_unittest
{
namespace
{
const Rigid kHere = Rigid::fromXyzYawPitchRoll(1, -2, 3, 0.7, -0.4, 2.5);
const Rigid kThere = Rigid::fromXyzYawPitchRoll(0.5, -1, 3.2, 0.1, 0.3, 1.9);
}  // namespace

TEST(PoseManifold, holdsWhatCeresAsksOfAManifold)
{
  using namespace ceres;  // its macro says Vector and means its own
  const PoseManifold manifold;
  for (const double size : {0.0, 1e-5, 0.1, 2.0})
  {
    const Eigen::VectorXd x = blockOf(kHere), y = blockOf(kThere);
    Eigen::VectorXd step(6);
    step << 0.3, -0.2, 0.5, 0.4, -0.6, 0.2;
    step *= size;
    EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, step, y, 1e-8);
  }
}

TEST(PoseManifold, keepsQuaternionsNormal)
{
  PoseBlock x = blockOf(kHere);
  Vector6d step;
  step << 1, 2, 3, 0.1, 0.2, 0.3;
  for (int k = 0; k < 10000; ++k) PoseManifold{}.Plus(x.data(), step.data(), x.data());
  EXPECT_NEAR(x.tail<4>().norm(), 1, 1e-15);
}

TEST(PoseManifold, derivativeOfBoxMinusEqualsCentralDifferences)
{
  checkJacobian(boxMinusByStep(kThere, kHere),
                [](const Eigen::VectorXd& step) -> Eigen::VectorXd
                { return boxMinus(boxPlus(kThere, Vector6d(step)), kHere); });
}
}  // namespace scanloom::pose_manifold_unittest
