#include "run/run/internal/TurnCorrelation.h"

#include <gtest/gtest.h>

#include "estimation/imu/AnalyticDrive.h"

namespace scanloom::turn_correlation_unittest
{
namespace
{
/** The drive's rates as an IMU turned by 90 deg reads them, stamped late by `late`. */
std::vector<ImuSample> turnedAside(Duration late)
{
  std::vector<ImuSample> samples = AnalyticDrive{}.samples(Timestamp{0s}, Timestamp{5s}, 10ms);
  for (ImuSample& sample : samples)
  {
    sample.gyro = Eigen::Vector3d(sample.gyro.y() + 0.05, -sample.gyro.x(), sample.gyro.z());
    sample.stamp += late;
  }
  return samples;
}

std::optional<double> withOneThatIsLateBy(Duration late)
{
  const std::vector<ImuSample> a = AnalyticDrive{}.samples(Timestamp{0s}, Timestamp{5s}, 5ms);
  const std::vector<ImuSample> b = turnedAside(late);
  return turnCorrelation({a, Rigid::identity()}, {b, Rigid::fromXyzYawPitchRoll(1, 2, 3, M_PI / 2, 0, 0)});
}
}  // namespace

TEST(TurnCorrelation, isOneForTheSameTurnsWhateverPoseAndBias) { EXPECT_GT(withOneThatIsLateBy(0ms), 0.99); }

TEST(TurnCorrelation, isSmallForStampsThatAreWrong)
{
  EXPECT_LT(withOneThatIsLateBy(1s), 0.6);
  EXPECT_LT(withOneThatIsLateBy(-1s), 0.6);
}

TEST(TurnCorrelation, isNoneAtRestAndForOtherTimes)
{
  std::vector<ImuSample> resting;
  for (Duration t{0}; t < 5s; t += 10ms) resting.push_back({Timestamp{t}, {0.01, 0, 0}, {0, 0, 9.8}});
  EXPECT_FALSE(turnCorrelation({resting, Rigid::identity()}, {resting, Rigid::identity()}));
  EXPECT_FALSE(withOneThatIsLateBy(1h));
}
}  // namespace scanloom::turn_correlation_unittest
