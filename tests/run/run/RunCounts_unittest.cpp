#include "run/run/internal/RunCounts.h"

#include <gtest/gtest.h>

namespace scanloom::run_counts_unittest
{
namespace
{
StateEstimate registeredWithShift(double metres)
{
  StateEstimate estimate;
  estimate.registration.emplace();
  estimate.map_shift = metres;
  return estimate;
}

RunCounts withDegenerate(int degenerate, int sound)
{
  RunCounts counts;
  StateEstimate estimate = registeredWithShift(0);
  estimate.health = Health::Degenerate;
  for (int i = 0; i < degenerate; ++i) counts.add(estimate);
  estimate.health = Health::Ok;
  for (int i = 0; i < sound; ++i) counts.add(estimate);
  return counts;
}
}  // namespace

TEST(RunCounts, aTwentiethOfThePosesMayBeBridgedByTheImu)
{
  EXPECT_TRUE(withDegenerate(1, 19).passed());
  EXPECT_EQ(withDegenerate(1, 19).outcome(), "DEGENERATE");
}

TEST(RunCounts, aDriveThatTheImuBridgesForLongerIsNoGoodResult)
{
  EXPECT_FALSE(withDegenerate(2, 19).passed());
  EXPECT_EQ(withDegenerate(2, 19).outcome(), "DEGENERATE");
}

TEST(RunCounts, aMapThatShiftsByCentimetresIsLevelledByGravity)
{
  RunCounts counts;
  counts.add(registeredWithShift(0.08));
  EXPECT_TRUE(counts.passed());
  EXPECT_EQ(counts.outcome(), "OK");
}

TEST(RunCounts, aMapThatJumpsIsNoGoodResult)
{
  RunCounts counts;
  counts.add(registeredWithShift(0.08));
  counts.add(registeredWithShift(1.2));
  counts.add(registeredWithShift(0));
  EXPECT_FALSE(counts.passed());
  EXPECT_EQ(counts.outcome(), "MAP JUMPED");
  EXPECT_EQ(counts.map_jumps, 1);
  EXPECT_EQ(counts.largest_shift, 1.2);
}
}  // namespace scanloom::run_counts_unittest
