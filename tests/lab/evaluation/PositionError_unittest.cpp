#include "lab/evaluation/PositionError.h"

#include <gtest/gtest.h>

namespace scanloom::position_error_unittest
{
namespace
{
/** 10 m along x in 10 s, a pose every `step`. */
Trajectory straight(Duration step, const Rigid& frame = Rigid::identity())
{
  Trajectory trajectory;
  for (Duration t{0}; t <= 10s; t += step)
    trajectory.push_back({Timestamp{t}, frame * Rigid{Eigen::Quaterniond::Identity(), {seconds(t), 0, 0}}});
  return trajectory;
}

TEST(PositionError, isZeroForTheSamePathInAnotherFrame)
{
  const Rigid elsewhere = Rigid::fromXyzYawPitchRoll(500, -80, 40, 2.4, 0.3, -0.2);

  const PositionError error = positionErrorFromFirstPose(straight(300ms), straight(10ms, elsewhere));

  EXPECT_LT(error.largest, 1e-9);
  EXPECT_EQ(error.poses, 34U);
  EXPECT_NEAR(error.path_length, 9.9, 1e-9);
}

TEST(PositionError, tellsLargestFinalAndRootMeanSquare)
{
  Trajectory estimate = straight(1s);
  estimate[4].map_T_body.translation.y() += 3;
  estimate[10].map_T_body.translation.z() -= 1;

  const PositionError error = positionErrorFromFirstPose(estimate, straight(10ms));

  EXPECT_DOUBLE_EQ(error.largest, 3);
  EXPECT_EQ(error.largest_at, Timestamp{4s});
  EXPECT_NEAR(error.final, 1, 1e-12);
  EXPECT_NEAR(error.root_mean_square, std::sqrt(10.0 / 11), 1e-12);
}

TEST(PositionError, growsWithDistanceWhenTheFirstRotationIsWrong)
{
  Trajectory estimate = straight(1s);
  estimate[0].map_T_body.rotation = expSo3({0, 0, 0.01});

  EXPECT_NEAR(positionErrorFromFirstPose(estimate, straight(10ms)).final, 10 * 0.01, 1e-4);
}

TEST(PositionError, comparesOnlyTheTimeThatBothHave)
{
  Trajectory reference = straight(10ms);
  reference.erase(reference.begin(), reference.begin() + 555);

  const PositionError error = positionErrorFromFirstPose(straight(1s), reference);

  EXPECT_EQ(error.poses, 5U);
  EXPECT_NEAR(error.path_length, 4, 1e-9);
}

TEST(PositionError, refusesTrajectoriesOfDifferentTimes)
{
  Trajectory later = straight(1s);
  for (StampedPose& pose : later) pose.stamp += 1h;

  EXPECT_THROW(positionErrorFromFirstPose(later, straight(1s)), std::invalid_argument);
  EXPECT_THROW(positionErrorFromFirstPose({}, straight(1s)), std::invalid_argument);
}
}  // namespace
}  // namespace scanloom::position_error_unittest
