#include "slam/HeadingDoubt.h"

#include "core/Angle.h"

#include <gtest/gtest.h>

using namespace scanloom;

namespace
{
const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

/** 20 m ahead of the map's begin, displaced by `one_sided`. */
RegistrationResult seenFrom(double x, const Eigen::Vector3d& one_sided)
{
  RegistrationResult seen;
  seen.target_T_source.translation = {x, 0, 0};
  seen.one_sided = one_sided;
  return seen;
}

HeadingDoubt after(const Eigen::Vector3d& one_sided)
{
  HeadingDoubt doubt;
  for (int x = 0; x <= 200; ++x) doubt.add(seenFrom(x, one_sided), kUp, {std::max(0.0, x - 40.0), 0, 0}, 1);
  return doubt;
}
}  // namespace

TEST(HeadingDoubt, isFourDisplacementsToTheSideOverTheLengthOfTheMap)
{
  const HeadingDoubt doubt = after({0.5, 0.2, 0.3});
  EXPECT_EQ(doubt.length(), 40);
  EXPECT_NEAR(doubt.deviation(), 4 * 0.2 / 40, 8e-4);
  EXPECT_EQ(after({0.5, 0, 0.3}).deviation(), 0) << "what displaces along the way turns nothing";
}

TEST(HeadingDoubt, isTheSameForManyScansAsForFew)
{
  HeadingDoubt many;
  for (int i = 0; i <= 2000; ++i)
    many.add(seenFrom(0.1 * i, {0, 0.2, 0}), kUp, {std::max(0.0, 0.1 * i - 40.0), 0, 0}, 0.1);
  EXPECT_NEAR(many.deviation(), after({0, 0.2, 0}).deviation(), 4e-4);
}

TEST(HeadingDoubt, letsAKeyframeTakeTheHeadingOfTheEstimateAndNothingElse)
{
  RegistrationResult fine = seenFrom(40, {0, 0.2, 0});
  fine.covariance = 1e-8 * Matrix6d::Identity();
  const Rigid estimate = Rigid::fromXyzYawPitchRoll(40.1, 0.1, 0, kDegree, kDegree / 2, kDegree / 2);
  const Vector6d step = boxMinus(withHeadingOf(estimate, fine, kUp, after({0, 0.2, 0})), fine.target_T_source);
  EXPECT_NEAR(step[5] / kDegree, 1, 0.02);
  EXPECT_NEAR(step.head<5>().norm(), 0, 1e-12);

  const Vector6d without = boxMinus(withHeadingOf(estimate, fine, kUp, after({0, 0, 0})), fine.target_T_source);
  EXPECT_EQ(without.norm(), 0);
}
