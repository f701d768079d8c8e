#include "lab/simulation/internal/Ground.h"
#include "lab/simulation/internal/Random.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace scanloom::ground_unittest
{
namespace
{
/** From 1.5 to 3 m above the long waves. */
Ray randomRay(const Ground& ground, Random& random)
{
  Eigen::Vector3d origin(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(1.5, 3));
  origin.z() += ground.smoothHeight(origin.x(), origin.y());
  Eigen::Vector3d direction(random.normal(), random.normal(), random.normal());
  return {origin, direction.normalized()};
}

TEST(Ground, isMetByARayWhereItsHeightIs)
{
  const Ground ground({1.6, 0.16}, {0.2, 60});
  Random random(1, RandomStream::Stand, 0);
  int met = 0;
  for (int i = 0; i < 10'000; ++i)
  {
    const Ray ray = randomRay(ground, random);
    const auto range = ground.intersect(ray, 50);
    if (!range) continue;
    ++met;
    const Eigen::Vector3d p = ray.at(*range);
    EXPECT_NEAR(p.z(), ground.height(p.x(), p.y()), 2e-6);
  }
  EXPECT_GT(met, 4000);
}

TEST(Ground, isNeverJumpedOver)
{
  const Ground ground({1.6, 0.16}, {0.2, 60});
  Random random(2, RandomStream::Stand, 0);
  for (int i = 0; i < 1000; ++i)
  {
    const Ray ray = randomRay(ground, random);
    const double range = ground.intersect(ray, 50).value_or(50);
    for (double before = 0; before < range - 0.01; before += 0.01)
    {
      const Eigen::Vector3d p = ray.at(before);
      ASSERT_GT(p.z(), ground.height(p.x(), p.y())) << "at " << before << " of " << range;
    }
  }
}

TEST(Ground, hasTheNormalOfItsHeights)
{
  const Ground ground({1.6, 0.16}, {0.2, 60});
  const double e = 1e-5, x = 3.3, y = -7.1;
  const Eigen::Vector3d east(2 * e, 0, ground.height(x + e, y) - ground.height(x - e, y));
  const Eigen::Vector3d north(0, 2 * e, ground.height(x, y + e) - ground.height(x, y - e));

  EXPECT_LT((ground.normal(x, y) - east.cross(north).normalized()).norm(), 1e-8);
}

TEST(Ground, hasTheReliefAndTheRoughnessThatWereAskedFor)
{
  const auto spread = [](const Ground& ground, double side, double step)
  {
    double lowest = 1e9, highest = -1e9;
    for (double y = 0; y <= side; y += step)
      for (double x = 0; x <= side; x += step)
      {
        lowest = std::min(lowest, ground.height(x, y));
        highest = std::max(highest, ground.height(x, y));
      }
    return highest - lowest;
  };
  EXPECT_NEAR(spread(Ground({1.5, 0}), 100, 0.5), 1.5, 0.08);
  EXPECT_NEAR(spread(Ground({0, 0.08}), 10, 0.05), 0.08, 0.008);
}

TEST(Ground, isAsSteepAsItsSlopesAre)
{
  const Ground ground({0, 0}, {0.2, 150});
  double steepest = 0, highest = 0;
  for (double x = -300; x < 300; x += 2)
    for (double y = -300; y < 300; y += 2)
    {
      const Eigen::Vector3d normal = ground.normal(x, y);
      steepest = std::max(steepest, normal.head<2>().norm() / normal.z());
      highest = std::max(highest, ground.height(x, y));
    }
  EXPECT_NEAR(steepest, 0.2, 1e-3);
  EXPECT_LE(highest, ground.highest());
}

TEST(Ground, withoutShortWavesHasItsSmoothHeight)
{
  const Ground ground({3, 0}, {0.2, 150});
  for (double x = -50; x < 400; x += 3.7)
    EXPECT_NEAR(ground.smoothHeight(x, 0.3 * x), ground.height(x, 0.3 * x), 1e-6) << x;
}
}  // namespace
}  // namespace scanloom::ground_unittest
