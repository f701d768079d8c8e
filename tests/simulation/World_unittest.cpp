#include "simulation/World.h"
#include "simulation/Random.h"

#include <gtest/gtest.h>

#include <set>

namespace scanloom
{
namespace
{
Ray randomRay(Random& random)
{
  const Eigen::Vector3d origin(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(1.5, 3));
  Eigen::Vector3d direction(random.normal(), random.normal(), random.normal());
  return {origin, direction.normalized()};
}

std::vector<Stem> someStems()
{
  const Eigen::AlignedBox2d area(Eigen::Vector2d(-30, -30), Eigen::Vector2d(30, 30));
  StandOptions options;
  options.tilt_deg = 8;
  return growStems(options, Ground(GroundOptions{}), area, {{0, 0}}, 3);
}

TEST(Ground, isMetByARayWhereItsHeightIs)
{
  const Ground ground({0.8, 0.08});
  Random random(1, RandomStream::Stand, 0);
  int met = 0;
  for (int i = 0; i < 10'000; ++i)
  {
    const Ray ray = randomRay(random);
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
  const Ground ground({0.8, 0.08});
  Random random(2, RandomStream::Stand, 0);
  for (int i = 0; i < 1000; ++i)
  {
    const Ray ray = randomRay(random);
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
  const Ground ground({0.8, 0.08});
  const double e = 1e-5, x = 3.3, y = -7.1;
  const Eigen::Vector3d east(2 * e, 0, ground.height(x + e, y) - ground.height(x - e, y));
  const Eigen::Vector3d north(0, 2 * e, ground.height(x, y + e) - ground.height(x, y - e));

  EXPECT_LT((ground.normal(x, y) - east.cross(north).normalized()).norm(), 1e-8);
}

TEST(Stem, isMetOnItsBarkFacingTheRay)
{
  const Stem stem{{5, 0, -1}, Eigen::Vector3d::UnitZ(), 0.2, 10};

  EXPECT_NEAR(stem.intersect({{0, 0, 0}, Eigen::Vector3d::UnitX()}).value(), 4.8, 1e-12);
  EXPECT_FALSE(stem.intersect({{0, 0.21, 0}, Eigen::Vector3d::UnitX()})) << "beside";
  EXPECT_FALSE(stem.intersect({{0, 0, 0}, -Eigen::Vector3d::UnitX()})) << "behind";
  EXPECT_FALSE(stem.intersect({{0, 0, 9.5}, Eigen::Vector3d::UnitX()})) << "above the top";
}

TEST(Stand, findsTheSameStemAsASearchThroughAll)
{
  const Stand stand(someStems());
  Random random(4, RandomStream::Stand, 0);
  int met = 0;
  for (int i = 0; i < 20'000; ++i)
  {
    const Ray ray = randomRay(random);
    double nearest = 40;
    for (const Stem& stem : stand.stems()) nearest = std::min(nearest, stem.intersect(ray).value_or(nearest));

    const auto hit = stand.intersect(ray, 40);
    met += hit.has_value();
    EXPECT_EQ(hit ? hit->range : 40, nearest);
  }
  EXPECT_GT(met, 2000);
}

TEST(Stand, keepsThePathFreeAndStemsApart)
{
  const std::vector<Stem> stems = someStems();
  ASSERT_GT(stems.size(), 200U);
  for (std::size_t i = 0; i < stems.size(); ++i)
  {
    EXPECT_GE(stems[i].foot.head<2>().norm(), StandOptions{}.free_lane);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE((stems[i].foot - stems[j].foot).head<2>().norm(), 0.8);
  }
}

TEST(World, meetsTheNearerOfGroundAndStem)
{
  const Ground ground(GroundOptions{});
  const World world(ground, StandOptions{}, {{0, 0}}, 1);
  const Stand stand(world.stems());
  Random random(6, RandomStream::Stand, 0);
  std::set<Surface> met;
  for (int i = 0; i < 5'000; ++i)
  {
    const Ray ray = randomRay(random);
    const double to_ground = ground.intersect(ray, 40).value_or(40);
    const auto bark = stand.intersect(ray, 40);
    const double to_stem = bark ? bark->range : 40;

    const auto hit = world.cast(ray, 40, 0);
    EXPECT_EQ(hit ? hit->range : 40, std::min(to_ground, to_stem));
    if (!hit) continue;
    EXPECT_EQ(hit->surface, to_stem < to_ground ? Surface::Stem : Surface::Ground);
    met.insert(hit->surface);
  }
  EXPECT_EQ(met.size(), 2U);
}

TEST(Random, neverRepeatsItselfAcrossStreamsAndPlaces)
{
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    for (int stream = 0; stream < 10; ++stream)
      for (std::uint64_t index = 0; index < 100; ++index)
        seen.insert(Random(seed, static_cast<RandomStream>(stream), index).bits());
  EXPECT_EQ(seen.size(), 10'000U);
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
}  // namespace scanloom
