#include "estimation/slam/internal/BiasOfReplacement.h"

#include "estimation/imu/AnalyticDrive.h"

#include <gtest/gtest.h>

namespace scanloom::bias_of_replacement_unittest
{
namespace
{
const Rigid kKnownTOther = Rigid::fromXyzYawPitchRoll(1.5, -2, 0.7, 2, 0.3, -0.4);
const ImuBias kKnown{{0.01, 0.002, -0.004}, {0.1, -0.05, 0.02}}, kOther{{-0.005, 0.006, 0.003}, {-0.15, 0.1, 0.2}};

ImuSample sampleElsewhere(const AnalyticDrive& drive, Timestamp t)
{
  ImuSample sample =
      sampleByDifferences([&](Timestamp stamp) { return drive.stateAt(stamp).map_T_imu * kKnownTOther; }, t);
  sample.gyro += kOther.gyro;
  sample.accel += kOther.accel;
  return sample;
}

std::vector<ImuSample> known(const AnalyticDrive& drive, Duration from, Duration to)
{
  std::vector<ImuSample> samples = drive.samples(Timestamp{from}, Timestamp{to}, 5ms);
  for (ImuSample& sample : samples)
  {
    sample.gyro += kKnown.gyro;
    sample.accel += kKnown.accel;
  }
  return samples;
}

TEST(BiasOfReplacement, isFoundWhileTheBodyDrivesAndTurns)
{
  const AnalyticDrive drive;
  std::vector<ImuSample> other;
  for (Timestamp t{2003ms}; t <= Timestamp{6s}; t += 10ms) other.push_back(sampleElsewhere(drive, t));

  const std::optional<ImuBias> bias = biasOfReplacement(known(drive, 1s, 5s), kKnown, other, kKnownTOther);

  ASSERT_TRUE(bias);
  EXPECT_LT((bias->gyro - kOther.gyro).norm(), 1e-4);
  EXPECT_LT((bias->accel - kOther.accel).norm(), 0.01);
}

TEST(BiasOfReplacement, isNotToldByLessThanASecond)
{
  const AnalyticDrive drive;
  std::vector<ImuSample> other;
  for (Timestamp t{4100ms}; t <= Timestamp{6s}; t += 10ms) other.push_back(sampleElsewhere(drive, t));

  EXPECT_FALSE(biasOfReplacement(known(drive, 1s, 5s), kKnown, other, kKnownTOther));
  EXPECT_FALSE(biasOfReplacement(known(drive, 1s, 5s), kKnown, {}, kKnownTOther));
  EXPECT_FALSE(biasOfReplacement({}, kKnown, other, kKnownTOther));
}
}  // namespace
}  // namespace scanloom::bias_of_replacement_unittest
