#include "estimation/slam/ConstantMotion.h"

#include "base/core/So3.h"

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
  ASSERT_EQ(samples.size(), 11U);
  EXPECT_EQ(samples.front().stamp, Timestamp{1s}) << "the first scan must be covered from its start";
  EXPECT_EQ(samples.back().gyro, Eigen::Vector3d::Zero());
  EXPECT_LT((samples.back().accel - Eigen::Vector3d(0, 0, 9.80665)).norm(), 1e-9);
  EXPECT_EQ(motion.samplesUntil(Timestamp{1105ms}).size(), 1U);  // the rest only
}

TEST(ConstantMotion, aWrongYearTakesNoMoreSamplesThanAHundredSeconds)
{
  EXPECT_LE(ConstantMotion(Timestamp{1s}).samplesUntil(Timestamp{std::chrono::hours{24 * 365}}).size(), 10'002U);
}

TEST(ConstantMotion, samplesHaveAFadingMeanOfTheTurnRatesAndALevelBodysForce)
{
  Rigid body = Rigid::fromXyzYawPitchRoll(1, 2, 3, 0.3, 0.2, 0.1);
  const Eigen::Vector3d turn(0.03, -0.02, 0.05);  // rad in 0.1 s
  ConstantMotion motion(Timestamp{0s});
  motion.update(estimateAt(Timestamp{0s}, body));
  double missing = 1;  // of the turn rate
  for (int i = 1; i <= 5; ++i)
  {
    const Timestamp now{i * 100ms};
    body.rotation = body.rotation * expSo3(turn);
    motion.update(estimateAt(now, body));
    missing /= 2;
    for (const ImuSample& sample : motion.samplesUntil(now + 100ms))
    {
      EXPECT_LT((sample.gyro - (1 - missing) * 10 * turn).norm(), 1e-9);
      EXPECT_LT((sample.accel - Eigen::Vector3d(0, 0, 9.80665)).norm(), 1e-9);
    }
  }
}
}  // namespace
}  // namespace scanloom::constant_motion_unittest
