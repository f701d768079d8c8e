#include "base/core/Rigid.h"

#include "base/core/Angle.h"

#include <gtest/gtest.h>

namespace scanloom::rigid_unittest
{
namespace
{
}

TEST(Rigid, yawPitchRollMatchesTheMatrixOfACalibrationFile)
{
  // name x y z yaw pitch roll and the 4x4 as a rig's extrinsics state them
  const Rigid pose = Rigid::fromXyzYawPitchRoll(1.5, 1.2, 2.5, 30 * kDegree, 15 * kDegree, -25 * kDegree);
  Eigen::Matrix4d expected;
  expected << 0.836516303738, -0.547881185410, -0.008165797847, 1.5,  //
      0.482962913145, 0.730194739748, 0.483283008776, 1.2,            //
      -0.258819045103, -0.408217893677, 0.875426098066, 2.5,          //
      0, 0, 0, 1;
  EXPECT_LT((pose.matrix() - expected).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT((pose.yawPitchRoll() - Eigen::Vector3d(30, 15, -25) * kDegree).norm(), 1e-13);
}

TEST(Rigid, inverseCancels)
{
  const Rigid a_T_b = Rigid::fromXyzYawPitchRoll(1, -2, 3, 0.4, -0.5, 2.0);
  EXPECT_LT(((a_T_b * a_T_b.inverse()).matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-14);
}

TEST(Rigid, boxMinusUndoesBoxPlus)
{
  const Rigid pose = Rigid::fromXyzYawPitchRoll(1, -2, 3, 0.4, -0.5, 2.0);
  Vector6d step;
  step << 0.1, -0.2, 0.3, 0.5, -0.1, 0.2;
  EXPECT_LT((boxMinus(boxPlus(pose, step), pose) - step).norm(), 1e-14);
}

TEST(Rigid, aChainOfManyStepsStaysRigid)
{
  Rigid pose;
  Vector6d step;
  step << 1e-3, 0, 0, 1e-3, -2e-3, 3e-3;
  for (int i = 0; i < 100000; ++i) pose = boxPlus(pose, step);
  EXPECT_NEAR(pose.rotation.norm(), 1, 1e-15);
  EXPECT_TRUE(pose.translation.allFinite());
}

TEST(Rigid, refusesAMatrixThatIsNotARotation)
{
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m(0, 0) = -1;
  EXPECT_THROW(Rigid::fromMatrix(m), std::invalid_argument);
}
}  // namespace scanloom::rigid_unittest
