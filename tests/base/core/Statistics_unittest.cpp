#include "base/core/Statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace scanloom::statistics_unittest
{
TEST(Statistics, quantilesLieBetweenNeighbours)
{
  EXPECT_DOUBLE_EQ(quantileOfSorted({1, 2, 3, 4, 5}, 0.5), 3);
  EXPECT_DOUBLE_EQ(quantileOfSorted({1, 2}, 0.25), 1.25);
  EXPECT_DOUBLE_EQ(quantileOfSorted({7}, 1), 7);
  EXPECT_DOUBLE_EQ(median({5, 1, 3}), 3);
  EXPECT_THROW(median({}), std::invalid_argument);
}

TEST(Statistics, theUpperMedianIsOneOfTheValues)
{
  EXPECT_EQ(upperMedian(std::vector<int>{5, 1, 3}), 3);
  EXPECT_EQ(upperMedian(std::vector<int>{4, 1, 3, 2}), 3);
  EXPECT_THROW(upperMedian(std::vector<int>{}), std::invalid_argument);
}

TEST(Statistics, theRobustDeviationOfNormalValuesIsTheirs)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal(5, 2);
  std::vector<double> values(100000);
  for (double& value : values) value = normal(random);
  for (std::size_t i = 0; i < 10000; ++i) values[i] = 1e6;
  EXPECT_NEAR(robustDeviation(values), 2, 0.35);  // a tenth of wild values widens it, but by no more
}

TEST(Statistics, aQuarterOfWildSamplesDoesNotTurnTheLine)
{
  std::vector<Sample2d> samples;
  for (int i = 0; i < 40; ++i) samples.push_back({1.0 * i, i % 4 == 0 ? 100.0 + i : 3 + 0.5 * i});
  const RobustLine line = theilSen(samples, 1e-9);
  EXPECT_NEAR(line.slope, 0.5, 1e-12);
  EXPECT_NEAR(line.intercept, 3, 1e-12);
  EXPECT_THROW(theilSen({{1, 2}, {1, 3}}, 1e-9), std::invalid_argument);
}

TEST(Statistics, theSlopesUncertaintyIsHonest)
{
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.1);
  int within_two_sigma = 0;
  for (int trial = 0; trial < 500; ++trial)
  {
    std::vector<Sample2d> samples;
    for (int i = 0; i < 30; ++i) samples.push_back({1.0 * i, 0.2 * i + noise(random)});
    const RobustLine line = theilSen(samples, 1e-9);
    within_two_sigma += std::abs(line.slope - 0.2) < 2 * line.slope_sigma ? 1 : 0;
  }
  EXPECT_NEAR(within_two_sigma / 500.0, 0.95, 0.05);
}
}  // namespace scanloom::statistics_unittest
