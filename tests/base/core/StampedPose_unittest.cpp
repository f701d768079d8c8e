#include "base/core/StampedPose.h"

#include <gtest/gtest.h>

namespace scanloom::stamped_pose_unittest
{
namespace
{
using namespace std::chrono_literals;

StampedPose poseAtX(std::int64_t ns, double x, double yaw = 0)
{
  return {fromNanoseconds(ns), Rigid::fromXyzYawPitchRoll(x, 0, 0, yaw, 0, 0)};
}

TEST(Trajectory, hasNoPoseInAGapWiderThanAllowed)
{
  const Trajectory trajectory{poseAtX(1000, 0), poseAtX(2000, 4)};

  EXPECT_FALSE(poseAt(trajectory, fromNanoseconds(1500), 999ns));
  EXPECT_TRUE(poseAt(trajectory, fromNanoseconds(1500), 1000ns));
  EXPECT_TRUE(poseAt(trajectory, fromNanoseconds(2000), 1ns));
}

TEST(Trajectory, isInterpolatedBetweenItsPosesAndNotBeyondThem)
{
  const Trajectory trajectory{poseAtX(1000, 0, 0), poseAtX(2000, 4, 1)};

  EXPECT_NEAR(poseAt(trajectory, fromNanoseconds(1250))->translation.x(), 1, 1e-12);
  EXPECT_NEAR(poseAt(trajectory, fromNanoseconds(1250))->yawPitchRoll()[0], 0.25, 1e-12);
  EXPECT_NEAR(poseAt(trajectory, fromNanoseconds(2000))->translation.x(), 4, 1e-12);
  EXPECT_FALSE(poseAt(trajectory, fromNanoseconds(999)));
  EXPECT_FALSE(poseAt(trajectory, fromNanoseconds(2001)));
}
}  // namespace
}  // namespace scanloom::stamped_pose_unittest
