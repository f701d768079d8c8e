#include "diagnosis/internal/PoseFinding.h"

#include <gtest/gtest.h>

namespace scanloom::pose_finding_unittest
{
namespace
{
/** About a lidar of which `near_share` (+-1 %) of 7000 points agree, before and after the correction. */
Verdict verdictOn(double near_share, const CloudAgreement::Correction& correction)
{
  CloudAgreement agreement;
  agreement.turns = 10;
  agreement.common = 7000;
  agreement.near_share = near_share;
  agreement.near_sigma = 0.01;
  agreement.correction = correction;
  return poseFinding("right", "left", agreement).verdict;
}
}  // namespace

/** 0.2 m along a street with two OS0-64, which is sound. */
TEST(PoseFinding, ofAnOffsetThatHardlyAnythingSpeaksForIsSound)
{
  EXPECT_EQ(verdictOn(0.946, {{-0.195, 0, 0}, {0, 0, 0}, 0.011, 0.001, 0.949, 1.02}), Verdict::Ok);
}

TEST(PoseFinding, ofAnOffsetWithoutWhichTheFitIsBetterIsAWarning)
{
  EXPECT_EQ(verdictOn(0.946, {{-0.195, 0, 0}, {0, 0, 0}, 0.011, 0.001, 0.960, 1.2}), Verdict::Warning);
}

/** 3 deg of yaw on stairs, where all that is seen is near. */
TEST(PoseFinding, ofATurnInCloseQuartersIsAWarningThoughAllPointsAgree)
{
  EXPECT_EQ(verdictOn(0.992, {{0, 0, 0}, {0, 0, 0.052}, 0.009, 0.002, 0.999, 1.65}), Verdict::Warning);
}
}  // namespace scanloom::pose_finding_unittest
