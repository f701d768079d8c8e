#include "lab/simulation/internal/Random.h"

#include <gtest/gtest.h>

#include <set>

namespace scanloom::random_unittest
{
namespace
{
TEST(Random, neverRepeatsItselfAcrossStreamsAndPlaces)
{
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    for (int stream = 0; stream < 10; ++stream)
      for (std::uint64_t index = 0; index < 100; ++index)
        seen.insert(Random(seed, static_cast<RandomStream>(stream), index).bits());
  EXPECT_EQ(seen.size(), 10'000U);
}

TEST(Random, isPoissonWithTheMean)
{
  Random random(7, RandomStream::Stand, 0);
  double sum = 0, squares = 0;
  constexpr int kDraws = 100'000;
  for (int i = 0; i < kDraws; ++i)
  {
    const int events = random.poisson(2.5);
    sum += events;
    squares += events * events;
  }
  const double mean = sum / kDraws;
  EXPECT_NEAR(mean, 2.5, 0.025);
  EXPECT_NEAR(squares / kDraws - mean * mean, 2.5, 0.05) << "variance and mean are equal";
}

TEST(Random, isNormal)
{
  Random random(5, RandomStream::Stand, 0);
  double sum = 0, squares = 0, beyond_two = 0;
  constexpr int kDraws = 100'000;
  for (int i = 0; i < kDraws; ++i)
  {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    beyond_two += std::abs(x) > 2;
  }
  EXPECT_NEAR(sum / kDraws, 0, 0.015);
  EXPECT_NEAR(squares / kDraws, 1, 0.02);
  EXPECT_NEAR(beyond_two / kDraws, 0.0455, 0.003);
}
}  // namespace
}  // namespace scanloom::random_unittest
