#include "diagnosis/internal/PoseFinding.h"

#include <gtest/gtest.h>

namespace scanloom::pose_finding_unittest
{
namespace
{
/** 91 % (+-1) of 7000 points agree; without an offset of 0.208 m (+-0.013) along x, `corrected` of them. */
Verdict ofOffsetAlongTheWay(double corrected)
{
  CloudAgreement agreement;
  agreement.turns = 10;
  agreement.common = 7000;
  agreement.near_share = 0.91;
  agreement.near_sigma = 0.01;
  agreement.correction = CloudAgreement::Correction{{-0.208, 0, 0}, {0, 0, 0}, 0.013, 0.001, corrected};
  return poseFinding("right", "left", agreement).verdict;
}
}  // namespace

TEST(PoseFinding, ofAnOffsetThatHardlyAnythingSpeaksForIsSound) { EXPECT_EQ(ofOffsetAlongTheWay(0.92), Verdict::Ok); }

TEST(PoseFinding, ofAnOffsetWithoutWhichMoreAgreesIsAWarning)
{
  EXPECT_EQ(ofOffsetAlongTheWay(0.96), Verdict::Warning);
}
}  // namespace scanloom::pose_finding_unittest
