#include "run/topics/internal/PredictedMotion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom
{
namespace
{
namespace predicted_motion_test
{
constexpr Timestamp kStart{Duration{1'700'000'000'000'000'000}};

/** A body that drives a circle of this radius (m) at this turn rate (rad/s), counted from its centre. */
struct Circle
{
  double radius = 5, rate = 0.4;

  Rigid at(double t) const
  {
    const double angle = rate * t;
    return Rigid::fromXyzYawPitchRoll(radius * std::sin(angle), -radius * std::cos(angle), 0, angle, 0, 0);
  }

  /** Of an IMU at the body's origin, with its axes. */
  ImuSample sample(double t) const
  {
    return {kStart + fromSeconds(t), {0, 0, rate}, {0, radius * rate * rate, kGravity}};
  }

  StateEstimate estimate(double t) const
  {
    StateEstimate estimate;
    estimate.stamp = kStart + fromSeconds(t);
    estimate.map_T_body = at(t);
    estimate.velocity = at(t).rotation * Eigen::Vector3d(radius * rate, 0, 0);
    return estimate;
  }
};

TEST(PredictedMotion, withoutAnEstimateThereIsNone)
{
  PredictedMotion motion;
  EXPECT_FALSE(motion.add(Circle{}.sample(0)));
}

TEST(PredictedMotion, goesOnAlongACircleAsTheImuSays)
{
  const Circle circle;
  PredictedMotion motion;
  motion.correct(circle.estimate(0));
  std::optional<PredictedMotion::Motion> predicted;
  for (int i = 1; i <= 60; ++i) predicted = motion.add(circle.sample(0.005 * i));
  ASSERT_TRUE(predicted);
  EXPECT_EQ(predicted->stamp, kStart + 300ms);
  EXPECT_LT((predicted->map_T_body.translation - circle.at(0.3).translation).norm(), 1e-3);
  EXPECT_LT(predicted->map_T_body.rotation.angularDistance(circle.at(0.3).rotation), 1e-6);
  EXPECT_LT((predicted->velocity - Eigen::Vector3d(2, 0, 0)).norm(), 1e-3);
  EXPECT_LT((predicted->turn_rate - Eigen::Vector3d(0, 0, 0.4)).norm(), 1e-9);
}

TEST(PredictedMotion, anEstimateOfThePastMovesThePresentByTheSamplesSince)
{
  const Circle circle;
  PredictedMotion motion;
  for (int i = 0; i <= 60; ++i) motion.add(circle.sample(0.005 * i));
  const PredictedMotion::Motion then = motion.correct(circle.estimate(0.1));
  EXPECT_EQ(then.stamp, kStart + 100ms);
  EXPECT_LT((then.map_T_body.translation - circle.at(0.1).translation).norm(), 1e-9);
  EXPECT_LT((then.turn_rate - Eigen::Vector3d(0, 0, 0.4)).norm(), 1e-9);
  const auto now = motion.add(circle.sample(0.305));
  ASSERT_TRUE(now);
  EXPECT_LT((now->map_T_body.translation - circle.at(0.305).translation).norm(), 1e-3);
}

TEST(PredictedMotion, theVelocityIsOfTheBodysOriginAlthoughTheImuIsElsewhere)
{
  const Circle circle;
  PredictedMotion motion;
  const Rigid body_T_imu = Rigid::fromXyzYawPitchRoll(1, 0, 0, 0, 0, 0);
  motion.setImu(body_T_imu);
  motion.add(circle.sample(0));
  StateEstimate estimate = circle.estimate(0);
  estimate.velocity = Eigen::Vector3d(2, 0.4, 0);  // the origin's, and rate x lever
  EXPECT_LT((motion.correct(estimate).velocity - Eigen::Vector3d(2, 0, 0)).norm(), 1e-9);
}

TEST(PredictedMotion, aSecondAfterTheLastEstimateNothingIsPredicted)
{
  const Circle circle;
  PredictedMotion motion;
  motion.correct(circle.estimate(0));
  EXPECT_TRUE(motion.add(circle.sample(0.9)));
  EXPECT_FALSE(motion.add(circle.sample(1.1)));
}
}  // namespace predicted_motion_test
}  // namespace
}  // namespace scanloom
