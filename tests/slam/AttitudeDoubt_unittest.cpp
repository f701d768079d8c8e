#include "slam/AttitudeDoubt.h"

#include "core/Angle.h"

#include <gtest/gtest.h>

#include <cmath>

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

AttitudeDoubt after(const Eigen::Vector3d& one_sided)
{
  AttitudeDoubt doubt;
  for (int x = 0; x <= 200; ++x) doubt.add(seenFrom(x, one_sided), kUp, {std::max(0.0, x - 40.0), 0, 0}, 1);
  return doubt;
}

/** How far a keyframe is turned from its fine registration to the estimate: deg, about x, y, z. */
Eigen::Vector3d turnToEstimate(const AttitudeDoubt& doubt)
{
  RegistrationResult fine = seenFrom(40, {0, 0, 0});
  fine.covariance = 1e-8 * Matrix6d::Identity();
  const Rigid estimate = Rigid::fromXyzYawPitchRoll(40.1, 0.1, 0, kDegree, 0, kDegree);
  const Vector6d step = boxMinus(withAttitudeOf(estimate, fine, kUp, doubt), fine.target_T_source);
  EXPECT_EQ(step.head<3>().norm(), 0) << "the position stays";
  return step.tail<3>() / kDegree;
}
}  // namespace

TEST(AttitudeDoubt, ofTheHeadingIsFourDisplacementsToTheSideOverTheLengthOfTheMap)
{
  const AttitudeDoubt doubt = after({0.5, 0.2, 0.3});
  EXPECT_EQ(doubt.length(), 40);
  EXPECT_NEAR(doubt.heading(), 4 * 0.2 / 40, 8e-4);
  EXPECT_EQ(after({0.5, 0, 0.3}).heading(), 0) << "what displaces along the way turns nothing";
}

TEST(AttitudeDoubt, ofTheTiltIsTheSameInAllDirectionsAcrossUp)
{
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, -0.2, 1).normalized();
  const Eigen::Matrix3d doubt = AttitudeDoubt().covariance(up);
  EXPECT_NEAR((doubt * up).norm(), 0, 1e-12);
  EXPECT_NEAR(doubt.trace(), 2 * std::pow(0.1 * kDegree, 2), 1e-12);
}

TEST(AttitudeDoubt, isTheSameForManyScansAsForFew)
{
  AttitudeDoubt many;
  for (int i = 0; i <= 2000; ++i)
    many.add(seenFrom(0.1 * i, {0, 0.2, 0}), kUp, {std::max(0.0, 0.1 * i - 40.0), 0, 0}, 0.1);
  EXPECT_NEAR(many.heading(), after({0, 0.2, 0}).heading(), 4e-4);
}

TEST(AttitudeDoubt, letsAKeyframeTakeTheTiltOfTheEstimateAndItsHeadingWhereThatIsDoubtful)
{
  const Eigen::Vector3d sure = turnToEstimate(after({0, 0, 0}));
  EXPECT_NEAR(sure.x(), 1, 0.01);
  EXPECT_NEAR(sure.z(), 0, 0.01);
  EXPECT_NEAR(turnToEstimate(after({0, 0.2, 0})).z(), 1, 0.02);
}
