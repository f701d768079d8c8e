#include "estimation/ndt/NdtMap.h"

#include "estimation/ndt/RayWorld.h"
#include "estimation/ndt/cellAt.h"
#include "support/with.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace scanloom::ndt_map_unittest
{
namespace
{
using Points = std::vector<Eigen::Vector3f>;

Points blockAt(const Eigen::Vector3f& corner)
{
  Points points;
  for (int i = 0; i < 27; ++i)
    points.push_back(corner + 0.3f * Eigen::Vector3f(static_cast<float>(i % 3) + 0.2f,
                                                     static_cast<float>(i / 3 % 3) + 0.2f,
                                                     static_cast<float>(i / 9) + 0.2f));
  return points;
}

Points together(Points a, const Points& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

BinnedPoints counted(const Points& points, const NdtOptions& options = {})
{
  return binned({{points, std::nullopt}}, options);
}

bool sameBits(const NdtMap& a, const NdtMap& b)
{
  return std::equal(a.cells().begin(), a.cells().end(), b.cells().begin(), b.cells().end(),
                    [](const GaussianCell& p, const GaussianCell& q)
                    { return p.mean == q.mean && p.covariance == q.covariance && p.points == q.points; });
}

TEST(NdtMap, putsNegativeCoordinatesIntoTheirOwnCells)
{
  const NdtMap map(together(blockAt({-1, -1, -1}), blockAt({0, 0, 0})), {});

  ASSERT_EQ(map.cells().size(), 2u);
  ASSERT_NE(cellAt(map, {-1, -1, -1}), nullptr);
  EXPECT_NEAR(cellAt(map, {-1, -1, -1})->mean.x(), -0.64, 1e-5);
  EXPECT_EQ(map.indexOf({-0.00002, 0.00002, -1}), Eigen::Vector3i(-1, 0, -1));
}

TEST(NdtMap, ofTooManyCellsLosesThoseOfFewPointsEvenly)
{
  Points points = together(blockAt({-5, 0, 0}), blockAt({-3, 0, 0}));
  for (int x = 0; x < 100; ++x) points.emplace_back(static_cast<float>(x) + 0.5f, 0.5f, 0.5f);
  NdtOptions options;
  options.min_points = 1;
  options.max_cells = 52;
  const NdtMap map(points, options);

  ASSERT_EQ(map.cells().size(), 52u);
  EXPECT_NE(cellAt(map, {-5, 0, 0}), nullptr);
  EXPECT_NE(cellAt(map, {-3, 0, 0}), nullptr);
  for (int x = 0; x < 100; x += 4)
  {
    int cells = 0;
    for (int i = 0; i < 4; ++i) cells += cellAt(map, {x + i, 0, 0}) != nullptr;
    EXPECT_EQ(cells, 2) << x;
  }
  options.max_cells = 102;
  EXPECT_EQ(NdtMap(points, options).cells().size(), 102u);
}

TEST(NdtMap, givesTheSameBitsForAnyOrderOfPoints)
{
  Points points = scanFrom(forest(1), Rigid::identity(), 2);
  const NdtMap one(points, {});
  std::shuffle(points.begin(), points.end(), std::mt19937_64(3));
  const NdtMap other(points, {});

  EXPECT_GT(one.cells().size(), 300u);
  EXPECT_TRUE(sameBits(one, other));
}

TEST(NdtMap, mergesAndForgetsKeyframesToTheBit)
{
  const Points a = scanFrom(forest(1), Rigid::identity(), 2), b = scanFrom(forest(1), Rigid::identity(), 3);
  const NdtMap of_b(b, {});
  NdtMap merged(a, {});
  merged.add(counted(b));
  NdtMap rebuilt(of_b);
  rebuilt.add(counted(a));
  EXPECT_TRUE(sameBits(merged, rebuilt));
  EXPECT_FALSE(sameBits(merged, of_b));

  merged.remove(counted(a));
  EXPECT_TRUE(sameBits(merged, of_b));
  EXPECT_EQ(merged.points(), of_b.points());
}

/** Every cell's Gaussian by its index, found by looking at all cells. */
TEST(NdtMap, findsTheSevenOrTwentySevenAroundACell)
{
  const NdtMap map(scanFrom(forest(1), Rigid::identity(), 2), {});
  std::map<std::tuple<int, int, int>, std::uint32_t> place_of;
  const auto tupleOf = [](const Eigen::Vector3i& i) { return std::make_tuple(i.x(), i.y(), i.z()); };
  for (std::uint32_t i = 0; i < map.cells().size(); ++i) place_of[tupleOf(map.indexOf(map.cells()[i].mean))] = i;

  for (const auto& [index, place] : place_of)
    for (const int neighbours : {1, 7, 27})
    {
      // Beside the cell, too: where there may be no Gaussian.
      const Eigen::Vector3i centre(std::get<0>(index) + 1, std::get<1>(index) - 1, std::get<2>(index) + 1);
      std::set<std::uint32_t> expected;
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z)
          {
            const int axes = std::abs(x) + std::abs(y) + std::abs(z);
            if (axes > (neighbours == 1 ? 0 : neighbours == 7 ? 1 : 3)) continue;
            const auto found = place_of.find(tupleOf(centre + Eigen::Vector3i(x, y, z)));
            if (found != place_of.end()) expected.insert(found->second);
          }
      std::array<std::uint32_t, 27> found;
      const std::size_t count = map.findAround(centre, neighbours, found.data());
      ASSERT_EQ(std::set<std::uint32_t>(found.begin(), found.begin() + count), expected) << centre.transpose();
      ASSERT_EQ(count, expected.size()) << "none twice";
    }
}

TEST(NdtMap, ofCoarserCellsIsThatOfThePoints)
{
  const auto points = scanFrom(forest(1), Rigid::identity(), 2);
  NdtOptions options;
  options.cell_size = 0.5;
  const NdtMap fine(points, options);
  for (const int factor : {2, 4, 5})
  {
    options.cell_size = 0.5 * factor;
    EXPECT_TRUE(sameBits(fine.coarser(factor), NdtMap(points, options))) << factor;
  }
  EXPECT_TRUE(sameBits(fine.coarser(2).coarser(2), fine.coarser(4)));
}

TEST(NdtLevels, areThoseOfThePointsWhetherEdgesAreMultiplesOrNot)
{
  const auto points = scanFrom(forest(1), Rigid::identity(), 2);
  const std::vector<double> sizes{4, 2.5, 2, 1};
  const std::vector<NdtMap> levels = ndtLevels(points, sizes, {});
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    NdtOptions options;
    options.cell_size = sizes[i];
    EXPECT_TRUE(sameBits(levels[i], NdtMap(points, options))) << sizes[i];
    EXPECT_EQ(levels[i].options().cell_size, sizes[i]);
  }
  EXPECT_THROW(ndtLevels(points, {}, {}), std::invalid_argument);
}

TEST(NdtMap, isTheSameOnAnyNumberOfThreads)
{
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t seed = 1; points.size() < 200'000; ++seed)
    for (const auto& p : scanFrom(forest(1), Rigid::identity(), seed)) points.push_back(p);
  const NdtMap many(points, {});
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(sameBits(many, NdtMap(points, {})));
}

TEST(NdtMap, leavesOutWhatHasNoPlace)
{
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const NdtMap map(together(blockAt({0, 0, 0}), {{nan, 0, 0}, {0, inf, 0}, {0, 0, -inf}, {3e30f, 0, 0}}), {});

  EXPECT_EQ(map.points(), 27u);
  EXPECT_EQ(map.cells().size(), 1u);
  EXPECT_EQ(cellAt(map, map.indexOf({1e30, nan, 0})), nullptr);
}

TEST(NdtMap, needsEnoughPointsForAGaussianButKeepsTheOthersForLater)
{
  NdtMap map({});
  const Points block = blockAt({0, 0, 0});
  map.add(counted({block.begin(), block.begin() + 3}));
  EXPECT_TRUE(map.cells().empty());
  map.add(counted({block.begin() + 3, block.end()}));

  ASSERT_EQ(map.cells().size(), 1u);
  EXPECT_EQ(map.cells()[0].points, 27u);
}

TEST(NdtMap, refusesOptionsAndMergesThatMakeNoSense)
{
  EXPECT_THAT([&] { NdtMap{with(&NdtOptions::cell_size, 0)}; },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("cell_size = 0 m")));

  NdtMap fine({});
  EXPECT_THROW(fine.add(counted({}, with(&NdtOptions::cell_size, 2))), std::invalid_argument);
  EXPECT_THROW(fine.remove(counted(blockAt({0, 0, 0}))), std::invalid_argument);
}
}  // namespace
}  // namespace scanloom::ndt_map_unittest
