#include "estimation/imu/ImuBuffer.h"

#include <gtest/gtest.h>

namespace scanloom::imu_buffer_unittest
{
namespace
{
Timestamp at(Duration since_epoch) { return Timestamp{since_epoch}; }

/** A reading that tells its own time: linear interpolation is exact on it. */
ImuSample ramp(Timestamp stamp)
{
  const double t = seconds(stamp.time_since_epoch());
  return {stamp, {t, 2 * t, 3}, {-t, 0, 9.8}};
}

ImuBuffer rampFrom10To50ms()
{
  ImuBuffer buffer;
  for (Duration t = 10ms; t <= 50ms; t += 10ms) EXPECT_TRUE(buffer.add(ramp(at(t))));
  return buffer;
}

std::vector<Timestamp> stampsOf(const std::vector<ImuSample>& samples)
{
  std::vector<Timestamp> stamps;
  for (const ImuSample& s : samples) stamps.push_back(s.stamp);
  return stamps;
}
}  // namespace

TEST(ImuBuffer, cutsExactlyAtBothEndsByInterpolation)
{
  const auto cut = rampFrom10To50ms().between(at(12ms), at(38ms));
  EXPECT_EQ(stampsOf(cut), (std::vector{at(12ms), at(20ms), at(30ms), at(38ms)}));
  for (const ImuSample& s : cut)
  {
    EXPECT_LT((s.gyro - ramp(s.stamp).gyro).norm(), 1e-15);
    EXPECT_LT((s.accel - ramp(s.stamp).accel).norm(), 1e-15);
  }
}

TEST(ImuBuffer, repeatsNoSampleThatLiesOnAnEnd)
{
  EXPECT_EQ(stampsOf(rampFrom10To50ms().between(at(20ms), at(40ms))), (std::vector{at(20ms), at(30ms), at(40ms)}));
}

TEST(ImuBuffer, cutsBetweenTwoNeighbours)
{
  EXPECT_EQ(stampsOf(rampFrom10To50ms().between(at(21ms), at(22ms))), (std::vector{at(21ms), at(22ms)}));
}

TEST(ImuBuffer, holdsTheNearestSampleWhereCoverageEnds)
{
  const auto cut = rampFrom10To50ms().between(at(5ms), at(70ms));
  EXPECT_EQ(cut.front().stamp, at(5ms));
  EXPECT_EQ(cut.front().gyro, ramp(at(10ms)).gyro);
  EXPECT_EQ(cut.back().stamp, at(70ms));
  EXPECT_EQ(cut.back().gyro, ramp(at(50ms)).gyro);
  EXPECT_EQ(cut.size(), 7u);
}

TEST(ImuBuffer, hasNothingForAnEmptyIntervalOrWithoutSamples)
{
  EXPECT_TRUE(rampFrom10To50ms().between(at(20ms), at(20ms)).empty());
  EXPECT_TRUE(rampFrom10To50ms().between(at(30ms), at(20ms)).empty());
  EXPECT_TRUE(ImuBuffer{}.between(at(10ms), at(20ms)).empty());
}

TEST(ImuBuffer, coversWhatNeedsNoExtrapolation)
{
  const ImuBuffer buffer = rampFrom10To50ms();
  EXPECT_TRUE(buffer.covers(at(10ms), at(50ms)));
  EXPECT_FALSE(buffer.covers(at(9ms), at(50ms)));
  EXPECT_FALSE(buffer.covers(at(10ms), at(51ms)));
  EXPECT_FALSE(ImuBuffer{}.covers(at(10ms), at(20ms)));
}

TEST(ImuBuffer, refusesWhatIsLateOrNotFinite)
{
  ImuBuffer buffer = rampFrom10To50ms();
  EXPECT_FALSE(buffer.add(ramp(at(50ms))));
  EXPECT_FALSE(buffer.add(ramp(at(45ms))));
  EXPECT_FALSE(buffer.add({at(60ms), {0, NAN, 0}, {0, 0, 9.8}}));
  EXPECT_FALSE(buffer.add({at(60ms), {0, 0, 0}, {0, INFINITY, 9.8}}));
  EXPECT_EQ(buffer.samples().size(), 5u);
}

TEST(ImuBuffer, forgetsWhatAnIntervalFromThereCannotNeed)
{
  ImuBuffer buffer = rampFrom10To50ms();
  const auto before = buffer.between(at(25ms), at(45ms));
  buffer.forgetBefore(at(25ms));
  EXPECT_EQ(buffer.samples().front().stamp, at(20ms));
  const auto after = buffer.between(at(25ms), at(45ms));
  EXPECT_EQ(stampsOf(after), stampsOf(before));
  EXPECT_EQ(after.front().gyro, before.front().gyro);

  buffer.forgetBefore(at(5ms));
  EXPECT_EQ(buffer.samples().front().stamp, at(20ms));
  buffer.forgetBefore(at(90ms));
  EXPECT_EQ(buffer.samples().size(), 1u);
}

TEST(ImuBuffer, tellsAGapFromAnIntervalThatIsMerelyNotAligned)
{
  ImuBuffer buffer = rampFrom10To50ms();
  buffer.add(ramp(at(100ms)));
  EXPECT_TRUE(buffer.coversDensely(at(12ms), at(50ms), 10ms));
  EXPECT_TRUE(buffer.coversDensely(at(5ms), at(50ms), 10ms)) << "begins 5 ms later";
  EXPECT_FALSE(buffer.coversDensely(at(5ms), at(50ms), 4ms));
  EXPECT_FALSE(buffer.coversDensely(at(60ms), at(70ms), 10ms)) << "within the gap";
  EXPECT_FALSE(buffer.coversDensely(at(12ms), at(60ms), 10ms)) << "into the gap";
  EXPECT_TRUE(buffer.coversDensely(at(12ms), at(60ms), 50ms));
  EXPECT_TRUE(buffer.coversDensely(at(100ms), at(105ms), 10ms)) << "ends 5 ms earlier";
  EXPECT_FALSE(buffer.coversDensely(at(200ms), at(205ms), 10ms)) << "ended long ago";
  EXPECT_FALSE(ImuBuffer().coversDensely(at(1ms), at(2ms), 10ms));
}
}  // namespace scanloom::imu_buffer_unittest
