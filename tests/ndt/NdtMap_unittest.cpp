#include "ndt/NdtMap.h"

#include "ndt/RayWorld.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tuple>

namespace scanloom
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
  ASSERT_NE(map.cellAt({-1, -1, -1}), nullptr);
  EXPECT_NEAR(map.cellAt({-1, -1, -1})->mean.x(), -0.64, 1e-5);
  EXPECT_EQ(map.indexOf({-0.00002, 0.00002, -1}), Eigen::Vector3i(-1, 0, -1));
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
  const NdtMap a(scanFrom(forest(1), Rigid::identity(), 2), {}), b(scanFrom(forest(1), Rigid::identity(), 3), {});
  NdtMap merged(a);
  merged.add(b);
  NdtMap rebuilt(scanFrom(forest(1), Rigid::identity(), 3), {});
  rebuilt.add(scanFrom(forest(1), Rigid::identity(), 2));
  EXPECT_TRUE(sameBits(merged, rebuilt));
  EXPECT_FALSE(sameBits(merged, b));

  merged.remove(a);
  EXPECT_TRUE(sameBits(merged, b));
  EXPECT_EQ(merged.points(), b.points());
}

TEST(NdtMap, listsCellsByIndexZThenYThenX)
{
  const NdtMap map(scanFrom(forest(1), Rigid::identity(), 2), {});
  const auto before = [&map](const GaussianCell& a, const GaussianCell& b)
  {
    const Eigen::Vector3i i = map.indexOf(a.mean), j = map.indexOf(b.mean);
    return std::make_tuple(i.z(), i.y(), i.x()) < std::make_tuple(j.z(), j.y(), j.x());
  };
  EXPECT_TRUE(std::is_sorted(map.cells().begin(), map.cells().end(), before));
}

TEST(NdtMap, leavesOutAndCountsWhatHasNoPlace)
{
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const NdtMap map(together(blockAt({0, 0, 0}), {{nan, 0, 0}, {0, inf, 0}, {0, 0, -inf}, {3e30f, 0, 0}}), {});

  EXPECT_EQ(map.pointsLeftOut(), 4u);
  EXPECT_EQ(map.points(), 27u);
  EXPECT_EQ(map.cells().size(), 1u);
  EXPECT_EQ(map.cellAt(map.indexOf({1e30, nan, 0})), nullptr);
}

TEST(NdtMap, needsEnoughPointsForAGaussianButKeepsTheOthersForLater)
{
  NdtMap map({});
  const Points block = blockAt({0, 0, 0});
  map.add(Points(block.begin(), block.begin() + 4));
  EXPECT_TRUE(map.cells().empty());
  map.add(Points(block.begin() + 4, block.end()));

  ASSERT_EQ(map.cells().size(), 1u);
  EXPECT_EQ(map.cells()[0].points, 27u);
}

TEST(NdtMap, refusesOptionsAndMergesThatMakeNoSense)
{
  NdtOptions none;
  none.cell_size = 0;
  EXPECT_THAT([&] { NdtMap{none}; },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("cell_size = 0 m")));

  NdtOptions coarse;
  coarse.cell_size = 2;
  NdtMap fine({});
  EXPECT_THROW(fine.add(NdtMap(coarse)), std::invalid_argument);
  EXPECT_THROW(fine.remove(NdtMap(blockAt({0, 0, 0}), {})), std::invalid_argument);
}
}  // namespace
}  // namespace scanloom
