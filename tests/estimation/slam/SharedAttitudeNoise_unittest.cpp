#include "estimation/slam/internal/SharedAttitudeNoise.h"

#include "base/core/Angle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::shared_attitude_noise_unittest
{
namespace
{
const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

/** At `x` m on a way straight on, displaced by `viewpoint_bias`. */
RegistrationResult seenFrom(double x, const Eigen::Vector3d& viewpoint_bias)
{
  RegistrationResult seen;
  seen.target_T_source.translation = {x, 0, 0};
  seen.viewpoint_bias = viewpoint_bias;
  return seen;
}

SharedAttitudeNoise after(const Eigen::Vector3d& viewpoint_bias)
{
  SharedAttitudeNoise doubt;
  for (int x = 0; x <= 200; ++x) doubt.add(seenFrom(x, viewpoint_bias), kUp, {std::max(0.0, x - 40.0), 0, 0}, 1);
  return doubt;
}

/** rad */
double headingDeviation(const SharedAttitudeNoise& doubt) { return std::sqrt(doubt.covariance(kUp)(5, 5)); }
}  // namespace

TEST(SharedAttitudeNoise, ofTheHeadingIsTheDisplacementToTheSideOverTheLengthOfTheMap)
{
  const SharedAttitudeNoise doubt = after({0.5, 0.2, 0.3});
  EXPECT_EQ(doubt.length(), 40);
  EXPECT_NEAR(headingDeviation(doubt), 0.2 / 40, 2e-4);
  EXPECT_EQ(headingDeviation(after({0.5, 0, 0.3})), 0) << "what displaces along the way turns nothing";
}

TEST(SharedAttitudeNoise, ofTheTiltIsTheSameInAllDirectionsAcrossUp)
{
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, -0.2, 1).normalized();
  const Matrix6d covariance = SharedAttitudeNoise().covariance(up);
  const Eigen::Matrix3d doubt = covariance.bottomRightCorner<3, 3>();
  EXPECT_EQ(covariance.topRows<3>().norm(), 0) << "positions are not doubted";
  EXPECT_NEAR((doubt * up).norm(), 0, 1e-12);
  EXPECT_NEAR(doubt.trace(), 2 * std::pow(0.03 * kDegree, 2), 1e-12);
}

TEST(SharedAttitudeNoise, isTheSameForManyScansAsForFew)
{
  SharedAttitudeNoise many;
  for (int i = 0; i <= 2000; ++i)
    many.add(seenFrom(0.1 * i, {0, 0.2, 0}), kUp, {std::max(0.0, 0.1 * i - 40.0), 0, 0}, 0.1);
  EXPECT_NEAR(headingDeviation(many), headingDeviation(after({0, 0.2, 0})), 4e-4);
}
}  // namespace scanloom::shared_attitude_noise_unittest
