#include "lab/simulation/internal/Wind.h"
#include "lab/simulation/internal/World.h"
#include "lab/simulation/mantle.h"
#include "support/with.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace scanloom::wind_unittest
{
namespace
{
constexpr double kTree = 19, kTrunk = 0.2;  // m: height and diameter

WindOptions windOf(double speed) { return with(&WindOptions::speed, speed, with(&WindOptions::direction_deg, 0)); }

ForestOptions forestIn(const WindOptions& wind)
{
  ForestOptions options;
  options.wind = wind;
  options.stand.reach = 30;
  return options;
}

World worldIn(const WindOptions& wind) { return World(Ground(GroundOptions{}), forestIn(wind), {{0, 0}}, 1); }

std::vector<RayQuery> fanOfQueries(const World& world)
{
  const Eigen::Vector3d eye(0.13, 0.17, world.ground().height(0.13, 0.17) + 2.5);
  std::vector<RayQuery> queries;
  for (int column = 0; column < 128; ++column)
    for (int beam = 0; beam < 32; ++beam)
    {
      const double azimuth = 2 * M_PI * column / 128, altitude = M_PI / 4 * (1 - beam / 15.5);
      const Eigen::Vector3d direction(std::cos(azimuth) * std::cos(altitude), std::sin(azimuth) * std::cos(altitude),
                                      std::sin(altitude));
      queries.push_back({{eye, direction}, 30, queries.size()});
    }
  return queries;
}

WindShift shiftAt(const World& world, const Eigen::Vector3d& p, double t)
{
  return world.wind().at(p.head<2>(), p.z() - world.ground().height(p.x(), p.y()), t);
}
}  // namespace

TEST(Wind, bendsStemsWithTheSquareOfTheHeightAndMovesNothingOnTheGround)
{
  const Wind wind(windOf(12), kTrunk, kTree, 1);
  const Eigen::Vector2d place(3, 4);
  EXPECT_EQ(wind.at(place, 0, 7).of_leaves.norm(), 0);
  EXPECT_LT((wind.at(place, 8, 7).of_wood - 4 * wind.at(place, 4, 7).of_wood).norm(), 1e-12);
}

TEST(Wind, pushesWithTheSquareOfItsSpeed)
{
  for (const double speed : {5.0, 10.0, 20.0})
  {
    const Wind wind(windOf(speed), kTrunk, kTree, 1);
    double sum = 0;
    const int samples = 20'000;
    for (int i = 0; i < samples; ++i) sum += wind.at({0, 0}, kTree, 0.05 * i).of_wood.x();
    const double expected = 0.3 * std::pow(speed / 10, 2);
    EXPECT_NEAR(sum / samples, expected, 0.02 * expected);
  }
}

/** Across the wind stems do nothing but sway. Their frequency: Moore and Maguire, Trees 18, 2004. */
TEST(Wind, makesStemsSwayAtTheirNaturalFrequency)
{
  const Wind wind(windOf(10), kTrunk, kTree, 1);
  const double natural = 0.0948 + 3.4317 * 20 / (19 * 19);  // Hz
  const double step = 0.01, seconds = 2000;
  int crossings = 0;
  for (double t = 0; t < seconds; t += step)
    crossings += wind.at({0, 0}, kTree, t).of_wood.y() < 0 && wind.at({0, 0}, kTree, t + step).of_wood.y() >= 0;
  EXPECT_NEAR(crossings / seconds, natural, 0.07 * natural);
}

TEST(Wind, movesNeighboursAlikeAndWithoutJumps)
{
  const Wind wind(windOf(15), kTrunk, kTree, 1);
  for (double t = 0; t < 60; t += 0.37)
  {
    const Eigen::Vector2d here = wind.at({5, 5}, 3, t).of_leaves;
    EXPECT_LT((wind.at({5.1, 5}, 3, t).of_leaves - here).norm(), 0.01);
    EXPECT_LT((wind.at({5, 5}, 3.1, t).of_leaves - here).norm(), 0.01);
    EXPECT_LT((wind.at({5, 5}, 3, t + 0.001).of_leaves - here).norm(), 0.001);
  }
}

/** Rays go through wind in pieces; without it in one. */
TEST(Wind, ofNearlyNothingChangesNothing)
{
  const World calm = worldIn(windOf(0)), breath = worldIn(windOf(1e-6));
  const std::vector<RayQuery> queries = fanOfQueries(calm);
  const auto expected = calm.cast(queries, 0), met = breath.cast(queries, 3);
  std::map<Surface, int> of_surface;
  int other = 0;
  for (std::size_t i = 0; i < queries.size(); ++i)
  {
    if (met[i]) ++of_surface[met[i]->surface];
    const bool same =
        met[i].has_value() == expected[i].has_value() &&
        (!met[i] || (met[i]->surface == expected[i]->surface && std::abs(met[i]->range - expected[i]->range) < 1e-3));
    other += !same;
  }
  EXPECT_LT(other, 8) << "of " << queries.size() << ": rays along the border of a voxel";
  EXPECT_GT(of_surface[Surface::Stem], 100);
  EXPECT_GT(of_surface[Surface::Crown], 100);
}

TEST(Wind, takesSurfacesFromWhereTheyRest)
{
  const World world = worldIn(windOf(15));
  const std::vector<RayQuery> queries = fanOfQueries(world);
  const double t = 12.3;
  const auto hits = world.cast(queries, t);
  int stems = 0, leaves = 0, outside = 0;
  for (std::size_t i = 0; i < queries.size(); ++i)
  {
    if (!hits[i]) continue;
    Eigen::Vector3d p = queries[i].ray.at(hits[i]->range);
    const WindShift shift = shiftAt(world, p, t);
    if (hits[i]->surface == Surface::Stem && hits[i]->id != 0)
    {
      ++stems;
      p.head<2>() -= shift.of_wood;
      EXPECT_NEAR(distanceToMantle(world.stems()[hits[i]->id].wood(), p), 0, 0.01 + 0.05 * shift.of_wood.norm());
    }
    if (hits[i]->surface == Surface::Crown)
    {
      ++leaves;
      p.head<2>() -= shift.of_leaves;
      const Eigen::Array3i voxel = world.foliage().voxels().voxelAt(p);
      outside += world.foliage().voxels().at(voxel.x(), voxel.y(), voxel.z()).isEmpty();
    }
  }
  EXPECT_GT(stems, 100);
  EXPECT_GT(leaves, 100);
  EXPECT_LT(outside, leaves / 10) << "ways are straight over 4 m";
}

/** What a ray meets at one time says nothing of the order in which it was asked. */
TEST(Wind, isAFunctionOfTimeAlone)
{
  const World world = worldIn(windOf(15));
  const std::vector<RayQuery> queries = fanOfQueries(world);
  const auto first = world.cast(queries, 5);
  world.cast(queries, 7);
  for (std::size_t i = queries.size(); i-- > 0;)
  {
    const auto again = world.cast(queries[i], 5);
    ASSERT_EQ(again.has_value(), first[i].has_value());
    if (!again) continue;
    ASSERT_EQ(again->range, first[i]->range);
  }
}

TEST(Wind, movesAScanSmoothly)
{
  const World world = worldIn(windOf(15));
  const std::vector<RayQuery> queries = fanOfQueries(world);
  const auto now = world.cast(queries, 5), soon = world.cast(queries, 5.001), later = world.cast(queries, 6.5);
  const auto changes = [&](const std::vector<std::optional<Hit>>& then, double tolerance)
  {
    int changed = 0;
    for (std::size_t i = 0; i < queries.size(); ++i)
      changed +=
          now[i].has_value() != then[i].has_value() || (now[i] && std::abs(now[i]->range - then[i]->range) > tolerance);
    return changed;
  };
  EXPECT_LT(changes(soon, 0.005), 30) << "of " << queries.size() << ", at edges";
  EXPECT_GT(changes(later, 0.005), 500);
}
}  // namespace scanloom::wind_unittest
