#include "lab/simulation/internal/Stand.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "support/messageOf.h"
#include "support/with.h"

namespace scanloom::stand_unittest
{
namespace
{
std::vector<Eigen::Vector2d> straightPath(double from, double to)
{
  std::vector<Eigen::Vector2d> path;
  for (double x = from; x <= to; x += 0.25) path.emplace_back(x, 0);
  return path;
}

StandOptions denseStand() { return with(&StandOptions::stems_per_hectare, 4000, with(&StandOptions::spacing, 0.5)); }

Stand grow(const StandOptions& options, const TreeOptions& trees = {}, double to = 200, std::uint64_t seed = 1)
{
  return growStand(options, trees, Ground(GroundOptions{}), Lane(straightPath(0, to)), seed);
}

/** Of the stems on a rectangle that the stand surely covers and the lane does not touch. */
std::vector<int> countsOnSquares(const Stand& stand, double side)
{
  constexpr double kFirstX = 0, kLastX = 200, kFirstY = 5, kLastY = 45;
  const int columns = static_cast<int>((kLastX - kFirstX) / side), rows = static_cast<int>((kLastY - kFirstY) / side);
  std::vector<int> counts(static_cast<std::size_t>(columns * rows));
  for (const Stem& stem : stand.stems)
  {
    const int column = static_cast<int>(std::floor((stem.foot.x() - kFirstX) / side));
    const int row = static_cast<int>(std::floor((stem.foot.y() - kFirstY) / side));
    if (column >= 0 && column < columns && row >= 0 && row < rows)
      ++counts[static_cast<std::size_t>(row * columns + column)];
  }
  return counts;
}

struct Moments
{
  double mean, variance;
};

template <typename Values>
Moments momentsOf(const Values& values)
{
  double sum = 0, squares = 0;
  for (const double value : values)
  {
    sum += value;
    squares += value * value;
  }
  const double mean = sum / static_cast<double>(values.size());
  return {mean, squares / static_cast<double>(values.size()) - mean * mean};
}

TEST(Stand, isAsDenseAsAskedFor)
{
  for (const double density : {500.0, 800.0, 3000.0, 5000.0})
  {
    StandOptions options = density < 1000 ? StandOptions{} : denseStand();
    options.stems_per_hectare = density;
    double mean = 0;
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6})
      mean += momentsOf(countsOnSquares(grow(options, {}, 200, seed), 10)).mean / 6;
    EXPECT_NEAR(mean, density / 100, 0.05 * density / 100) << density;
  }
}

TEST(Stand, clustersWithoutChangingItsDensity)
{
  StandOptions clustered = denseStand();
  clustered.clustering = 0.9;
  const Moments even = momentsOf(countsOnSquares(grow(denseStand()), 4));
  const Moments grouped = momentsOf(countsOnSquares(grow(clustered), 4));

  EXPECT_NEAR(grouped.mean, even.mean, 0.1 * even.mean);
  EXPECT_LT(even.variance / even.mean, 1) << "stems that keep their distance are more even than chance";
  EXPECT_GT(grouped.variance / grouped.mean, 1.3) << "groups are less even";
}

TEST(Stand, keepsStemsApartAndTheLaneFree)
{
  const StandOptions options = denseStand();
  const std::vector<Stem> stems = grow(options, {}, 20).stems;
  ASSERT_GT(stems.size(), 3000U);
  for (std::size_t i = 0; i < stems.size(); ++i)
  {
    const double x = std::clamp(stems[i].foot.x(), 0.0, 20.0);
    EXPECT_GE((stems[i].foot.head<2>() - Eigen::Vector2d(x, 0)).norm(), 2.6 - 0.01);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE((stems[i].foot - stems[j].foot).head<2>().norm(), options.spacing);
  }
}

TEST(Stand, leavesStumpsWhereTheLaneFells)
{
  StandOptions options;
  options.stumps_per_hectare = 0;
  const Stand stand = grow(options);

  const double lane = 2 * 2.6 * 200 + M_PI * std::pow(2.6, 2);  // m2
  const double expected = options.stems_per_hectare / 1e4 * lane;
  EXPECT_NEAR(static_cast<double>(stand.stumps.size()), expected, 4 * std::sqrt(expected));
  const Ground ground(GroundOptions{});
  for (const Cone& stump : stand.stumps)
    EXPECT_NEAR(stump.tip().z() - ground.height(stump.tip().x(), stump.tip().y()), 0.25, 0.05);
}

TEST(Stand, hasTheDiametersThatWereAskedFor)
{
  std::vector<double> diameters;
  for (const Stem& stem :
       grow(denseStand(), with(&TreeOptions::diameter, 0.07, with(&TreeOptions::diameter_spread, 0.04))).stems)
  {
    diameters.push_back(stem.diameter);
    const Eigen::Vector3d breast = stem.foot + 1.3 * stem.axis;
    const Cone wood = stem.wood();
    EXPECT_NEAR(wood.base_radius + (wood.tip_radius - wood.base_radius) * (breast - wood.base).norm() / wood.length,
                0.5 * stem.diameter, 1e-12);
  }
  ASSERT_GT(diameters.size(), 5000U);
  const Moments moments = momentsOf(diameters);
  EXPECT_NEAR(moments.mean, 0.07, 0.002);
  EXPECT_NEAR(std::sqrt(moments.variance), 0.04, 0.002);
  EXPECT_GT(*std::min_element(diameters.begin(), diameters.end()), 0);
}

/** What an hour's drive meets does not depend on where it began. */
TEST(Stand, dependsOnTheSeedAndThePlaceAlone)
{
  const auto around = [](const Stand& stand)
  {
    std::vector<double> rows;
    for (const Stem& stem : stand.stems)
      if (stem.foot.x() > 60 && stem.foot.x() < 100 && std::abs(stem.foot.y()) < 40)
        for (const double value : {stem.foot.x(), stem.foot.y(), stem.foot.z(), stem.diameter, stem.length, stem.turn})
          rows.push_back(value);
    return rows;
  };
  const auto from = [](double first, double last, std::uint64_t seed)
  { return growStand(StandOptions{}, TreeOptions{}, Ground(GroundOptions{}), Lane(straightPath(first, last)), seed); };
  const std::vector<double> whole = around(from(0, 200, 1));

  EXPECT_GT(whole.size(), 6 * 150U);
  EXPECT_EQ(around(from(40, 120, 1)), whole);
  EXPECT_NE(around(from(0, 200, 2)), whole);
}

/** So that memory and time grow with the length of the path, not with the square that it lies in. */
TEST(Stand, isGrownAroundTheLaneOnly)
{
  StandOptions options;
  options.reach = 40;
  std::vector<Eigen::Vector2d> diagonal;
  for (double x = 0; x <= 220; x += 0.15) diagonal.emplace_back(x, x);
  const Stand stand = growStand(options, {}, Ground(GroundOptions{}), Lane(diagonal), 1);

  const double tile = 16;
  double farthest = 0;
  for (const Stem& stem : stand.stems)
  {
    const Eigen::Vector2d p = stem.foot.head<2>();
    const double along = std::clamp(0.5 * (p.x() + p.y()), 0.0, 220.0);
    farthest = std::max(farthest, (p - Eigen::Vector2d(along, along)).norm());
  }
  EXPECT_GT(farthest, options.reach);
  EXPECT_LT(farthest, options.reach + 1.5 * tile);
}

TEST(Stand, refusesMoreStemsThanTheirSpacingAllows)
{
  StandOptions options = denseStand();
  options.spacing = 1.5;
  EXPECT_THAT(messageOf<std::invalid_argument>([&] { grow(options); }),
              testing::HasSubstr("[simulated_stand] spacing = 1.5 m"));
}
}  // namespace
}  // namespace scanloom::stand_unittest
