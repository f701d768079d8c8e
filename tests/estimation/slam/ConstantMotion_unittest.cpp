#include "estimation/slam/ConstantMotion.h"

#include "estimation/imu/Preintegration.h"

#include <gtest/gtest.h>

namespace scanloom::constant_motion_unittest
{
namespace
{
StateEstimate estimateAt(Timestamp stamp, const Rigid& map_T_body)
{
  StateEstimate estimate;
  estimate.stamp = stamp;
  estimate.map_T_body = map_T_body;
  return estimate;
}

TEST(ConstantMotion, isALevelRestUntilTheFirstEstimate)
{
  ConstantMotion motion(Timestamp{1s});
  const auto samples = motion.samplesUntil(Timestamp{1100ms});
  ASSERT_EQ(samples.size(), 10U);
  EXPECT_EQ(samples.back().gyro, Eigen::Vector3d::Zero());
  EXPECT_LT((samples.back().accel - Eigen::Vector3d(0, 0, 9.80665)).norm(), 1e-9);
  EXPECT_EQ(motion.samplesUntil(Timestamp{1105ms}).size(), 1U);  // the rest only
}

TEST(ConstantMotion, aWrongYearTakesNoMoreSamplesThanAHundredSeconds)
{
  EXPECT_LE(ConstantMotion(Timestamp{1s}).samplesUntil(Timestamp{std::chrono::hours{24 * 365}}).size(), 10'001U);
}

TEST(ConstantMotion, samplesIntegrateToAStraightLineAndTheSameTurnAgain)
{
  const Rigid first = Rigid::fromXyzYawPitchRoll(1, 2, 3, 0.3, 0.2, 0.1);
  const Rigid turn = Rigid::fromXyzYawPitchRoll(0, 0, 0, 0.05, -0.02, 0.03);
  ConstantMotion motion(Timestamp{1s});
  motion.update(estimateAt(Timestamp{900ms}, first));
  motion.update(estimateAt(Timestamp{1s}, first * turn));

  NavState state;
  state.stamp = Timestamp{1010ms};
  const auto samples = motion.samplesUntil(Timestamp{1100ms});
  const Rigid now = first * turn;
  const Eigen::AngleAxisd rate(Eigen::Quaterniond((first.inverse() * now).rotation));
  const auto turned = [&](double share)
  { return Eigen::Quaterniond(Eigen::AngleAxisd(share * rate.angle(), rate.axis())); };
  state.map_T_imu = {now.rotation * turned(0.1), now.translation};
  state.velocity = {1, 2, 3};
  const NavState end = predictAt(state, samples, {Timestamp{1100ms}}).front();

  EXPECT_LT((end.velocity - Eigen::Vector3d(1, 2, 3)).norm(), 1e-3);
  EXPECT_LT((end.map_T_imu.translation - (now.translation + 0.09 * Eigen::Vector3d(1, 2, 3))).norm(), 1e-4);
  EXPECT_LT(end.map_T_imu.rotation.angularDistance(now.rotation * turned(1)), 1e-6);
}
}  // namespace
}  // namespace scanloom::constant_motion_unittest
