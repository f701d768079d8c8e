#include "estimation/slam/internal/InnovationMonitor.h"

#include <gtest/gtest.h>

namespace scanloom::innovation_monitor_unittest
{
namespace
{
TEST(InnovationMonitor, isTheMedianOfTenSecondsWhichSingleScansDoNotMove)
{
  InnovationMonitor contradiction;
  Timestamp t{0s};
  for (int i = 0; i < 100; ++i, t += 100ms) contradiction.add(t, i % 3 == 0 ? 50 : 1);
  EXPECT_EQ(contradiction.median(), 0) << "ten seconds are not over";

  contradiction.add(t, 1);
  EXPECT_EQ(contradiction.median(), 1);

  for (int i = 0; i < 60; ++i) contradiction.add(t += 100ms, 9);
  EXPECT_EQ(contradiction.median(), 9);
  for (int i = 0; i < 60; ++i) contradiction.add(t += 100ms, 1);
  EXPECT_EQ(contradiction.median(), 1);
}

TEST(InnovationMonitor, isNotToldByAFewRegistrationsOrAfterAPause)
{
  InnovationMonitor contradiction;
  for (const Duration t : {0s, 4s, 8s, 12s}) contradiction.add(Timestamp{t}, 20);
  EXPECT_EQ(contradiction.median(), 0);

  contradiction.add(Timestamp{100s}, 20);
  EXPECT_EQ(contradiction.median(), 0);

  contradiction.clear();
  EXPECT_EQ(contradiction.median(), 0);
}
}  // namespace
}  // namespace scanloom::innovation_monitor_unittest
