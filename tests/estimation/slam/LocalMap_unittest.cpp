#include "estimation/slam/internal/LocalMap.h"

#include "estimation/ndt/cellAt.h"
#include "estimation/slam/MapNearby.h"
#include "estimation/slam/PriorMap.h"
#include "support/with.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::local_map_unittest
{
namespace
{
/** A full cube of points around the origin of the body, one cell of the map. */
PointCloud cubePoints()
{
  PointCloud points;
  points.resize(27);
  for (std::size_t i = 0; i < 27; ++i)
  {
    points.x[i] = 0.3f + 0.2f * static_cast<float>(i % 3);
    points.y[i] = 0.3f + 0.2f * static_cast<float>(i / 3 % 3);
    points.z[i] = 0.3f + 0.2f * static_cast<float>(i / 9);
  }
  return points;
}

std::vector<View> cube() { return viewsOf(cubePoints(), {}); }

Rigid at(double x, double yaw_deg = 0) { return Rigid::fromXyzYawPitchRoll(x, 0, 0, yaw_deg * M_PI / 180, 0, 0); }
}  // namespace

TEST(LocalMap, wantsAKeyframeFirstAndThenAfterTravelOrTurn)
{
  LocalMap map({}, {});
  EXPECT_TRUE(map.wants(at(0)));
  map.add(cube(), at(0), Matrix6d::Zero());
  EXPECT_FALSE(map.wants(at(3.9)));
  EXPECT_TRUE(map.wants(at(4.0)));
  EXPECT_FALSE(map.wants(at(0, 19)));
  EXPECT_TRUE(map.wants(at(0, 21)));
}

TEST(LocalMap, keepsTheLastKeyframes)
{
  LocalMap map(with(&LocalMapOptions::keyframes, 3), {});
  for (int i = 0; i < 5; ++i) map.add(cube(), at(10 * i), Matrix6d::Zero());
  EXPECT_EQ(map.ndt().points(), 3u * 27u);
  EXPECT_EQ(cellAt(map.ndt(), {10, 0, 0}), nullptr);
  ASSERT_NE(cellAt(map.ndt(), {40, 0, 0}), nullptr);
  EXPECT_NEAR(cellAt(map.ndt(), {40, 0, 0})->mean.x(), 40.5, 1e-4);
}

TEST(LocalMap, keepsAllWithinTheRadiusAndTakesUpThoseOfAnEarlierPass)
{
  LocalMap map(with(&LocalMapOptions::radius, 15), {});
  for (const double x : {0, 10, 20, 30}) map.add(cube(), at(x), Matrix6d::Zero());
  EXPECT_EQ(cellAt(map.ndt(), {0, 0, 0}), nullptr);
  EXPECT_EQ(map.ndt().points(), 2u * 27u);
  map.add(cube(), at(5), Matrix6d::Zero());
  EXPECT_EQ(map.ndt().points(), 4u * 27u) << "0, 5, 10 and 20";
  ASSERT_NE(cellAt(map.ndt(), {0, 0, 0}), nullptr);
}

TEST(LocalMap, keyframesThatOverlapShareCells)
{
  LocalMap map({}, {});
  map.add(cube(), at(0), Matrix6d::Zero());
  map.add(cube(), at(0), Matrix6d::Zero());
  EXPECT_EQ(map.ndt().cells().size(), 1u);
  EXPECT_EQ(map.ndt().cells().front().points, 54u);
}

TEST(LocalMap, creepsByEachAlignmentWhereOneKeyframeIsTheMap)
{
  LocalMap map(with(&LocalMapOptions::keyframes, 1), {});
  Matrix6d alignment = Matrix6d::Zero();
  alignment.diagonal() << 1e-4, 4e-4, 0, 0, 0, 1e-6;  // m2, rad2
  EXPECT_EQ(map.add(cube(), at(0), alignment).norm(), 0) << "the first keyframe is where the map begins";
  for (const double x : {4.0, 8.0})
  {
    const Matrix6d at_origin = map.add(cube(), at(x), alignment);
    EXPECT_NEAR(at_origin(1, 1), 4e-4 + x * x * 1e-6, 1e-9) << x;
    EXPECT_NEAR(at_origin(5, 5), 1e-6, 1e-12) << x;
  }
}

TEST(LocalMap, creepsTheLessTheMoreKeyframesItIsTheMeanOf)
{
  LocalMap map({}, {});
  const Matrix6d alignment = 1e-4 * Matrix6d::Identity();
  map.add(cube(), at(0), alignment);
  // The second of two keyframes has half the weight of their mean, the third of three a third.
  EXPECT_NEAR(map.add(cube(), at(0), alignment)(0, 0), 1e-4 / 4, 1e-9);
  EXPECT_NEAR(map.add(cube(), at(0), alignment)(0, 0), 1e-4 / 9, 1e-9);
}

TEST(LocalMap, aKeyframeIsAlignedToWhatItSees)
{
  LocalMap map({}, {});
  const Matrix6d alignment = 1e-4 * Matrix6d::Identity();
  map.add(cube(), at(0), alignment);
  for (int i = 0; i < 9; ++i) map.add(cube(), at(4), alignment);
  LocalMap further = map;
  EXPECT_GT(map.add(cube(), at(0), alignment)(2, 2), 1.5 * further.add(cube(), at(4), alignment)(2, 2))
      << "it sees the first keyframe, which has no error, instead of the nine; alike if all counted alike";
}

namespace
{
/** Keyframes of an earlier drive, each of a cube. */
std::shared_ptr<const PriorMap> priorWith(const std::vector<double>& places,
                                          const std::vector<Matrix6d>& covariances = {})
{
  std::vector<Keyframe> keyframes;
  for (const double x : places) keyframes.push_back({Timestamp{}, at(x), cubePoints()});
  return std::make_shared<const PriorMap>(keyframes, std::vector<MountedLidar>{{}}, SlamSettings{}, covariances);
}
}  // namespace

TEST(PriorMap, isAsSureOfAPlaceAsItsNearestKeyframe)
{
  Matrix6d heading = Matrix6d::Zero();
  heading(5, 5) = 1e-4;  // 0.01 rad of heading
  const auto map = priorWith({0, 10}, {1e-6 * Matrix6d::Identity(), heading});
  const Matrix6d beyond = map->covarianceAt(at(13));
  EXPECT_NEAR(beyond(1, 1), 9e-4, 1e-9) << "3 m ahead, a heading moves the body by 3 m x 0.01";
  EXPECT_NEAR(map->covarianceAt(at(1))(5, 5), 1e-6, 1e-12);
  EXPECT_EQ(priorWith({0})->covarianceAt(at(0)).norm(), 0) << "not known";
}

TEST(MapNearby, givesEachKeyframeOnceTheBodyIsNear)
{
  MapNearby map(priorWith({0, 40, 100}));
  StateEstimate estimate;
  EXPECT_FALSE(map.next(estimate)) << "not in the map";
  estimate.in_map = estimate.entered_map = true;
  const std::optional<Keyframe> first = map.next(estimate);
  estimate.entered_map = false;
  ASSERT_TRUE(first);
  EXPECT_EQ(first->map_T_body.translation.x(), 0);
  EXPECT_GT(first->points.size(), 0U);
  EXPECT_EQ(map.next(estimate)->map_T_body.translation.x(), 40);
  EXPECT_FALSE(map.next(estimate)) << "100 m are not near";
  estimate.map_T_body = at(60);
  EXPECT_EQ(map.next(estimate)->map_T_body.translation.x(), 100);
  estimate.entered_map = true;
  EXPECT_TRUE(map.next(estimate)) << "whoever shows it forgot the frame before";
}

TEST(LocalMap, takesUpTheNearestKeyframesOfAnEarlierDrive)
{
  LocalMap map(with(&LocalMapOptions::keyframes, 2), SlamSettings{}.map_cells, priorWith({0, 10, 20, 60}));
  map.moveTo({1, 0, 0});
  EXPECT_EQ(map.ndt().points(), 2u * 27u) << "0 and 10";
  map.moveTo({2.5, 0, 0});
  map.moveTo({16, 0, 0});
  EXPECT_EQ(map.ndt().points(), 2u * 27u) << "10 and 20";
  EXPECT_EQ(cellAt(map.ndt(), {0, 0, 0}), nullptr);
  map.moveTo({100, 0, 0});
  EXPECT_EQ(map.ndt().points(), 0u);
  EXPECT_TRUE(map.empty());
}

TEST(LocalMap, wantsOwnKeyframesOnlyWhereNeitherDriveHasOne)
{
  LocalMap map({}, SlamSettings{}.map_cells, priorWith({0, 10}));
  map.moveTo({5, 0, 0});
  EXPECT_FALSE(map.wants(at(3.9)));
  EXPECT_FALSE(map.wants(at(10, 90)));
  EXPECT_TRUE(map.wants(at(5)));
  map.add(cube(), at(5), Matrix6d::Zero());
  EXPECT_FALSE(map.wants(at(5)));
}

TEST(LocalMap, creepsTheLessTheMoreOfAnEarlierDriveItHas)
{
  const Matrix6d alignment = 1e-4 * Matrix6d::Identity();
  LocalMap map({}, SlamSettings{}.map_cells, priorWith({0, 0, 0}));
  map.moveTo({0, 0, 0});
  EXPECT_NEAR(map.add(cube(), at(0), alignment)(0, 0), 1e-4 / 16, 1e-9) << "one keyframe of four has an error";
}
}  // namespace scanloom::local_map_unittest
