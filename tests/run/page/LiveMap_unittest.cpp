#include "run/page/internal/LiveMap.h"

#include "base/core/Bytes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace scanloom::live_map_unittest
{
namespace
{
struct Read
{
  std::size_t map_points = 0, path_points = 0, scans = 0;
  std::uint32_t map_epoch = 0;
  Eigen::Vector3d last_point = Eigen::Vector3d::Zero();
};

Read read(const std::string& messages)
{
  const std::vector<std::uint8_t> copy(messages.begin(), messages.end());
  const Bytes bytes(copy);
  Read read;
  for (std::size_t at = 0; at < bytes.size();)
  {
    const auto kind = load<std::uint32_t>(bytes, at), size = load<std::uint32_t>(bytes, at + 4);
    const Bytes payload = bytes.slice(at + 8, size);
    const auto first = load<std::uint32_t>(payload, 0), points = load<std::uint32_t>(payload, 4);
    if (kind == 1)
    {
      read.map_epoch = first;
      read.map_points += points;
      for (std::size_t k = 0; points > 0 && k < 3; ++k)
        read.last_point[static_cast<Eigen::Index>(k)] =
            load<double>(payload, 8 + 8 * k) + 0.01 * load<std::int16_t>(payload, size - 8 + 2 * k);
    }
    if (kind == 2) ++read.scans;
    if (kind == 3) read.path_points += points;
    at += 8 + size;
  }
  return read;
}

PlacedCloud cloud(std::size_t points, double spacing, const Eigen::Vector3d& at = Eigen::Vector3d::Zero())
{
  PlacedCloud placed;
  placed.map_T_begin.translation = placed.map_T_end.translation = at;
  for (std::size_t i = 0; i < points; ++i)
  {
    const auto x = static_cast<float>(i % 1000), y = static_cast<float>(i / 1000);
    placed.points.positions.push_back(Eigen::Vector3f(x, y, 1) * static_cast<float>(spacing));
    placed.points.t.push_back(0);
    placed.points.reflectivity.push_back(7);
    placed.points.lidar.push_back(1);
  }
  return placed;
}

LiveNews keyframe(PlacedCloud placed) { return {{}, {std::move(placed)}, {}, false}; }
}  // namespace

TEST(LiveMap, aPageThatComesLateGetsAllOfIt)
{
  LiveMap map;
  for (int i = 0; i < 5; ++i) map.add(keyframe(cloud(1000, 0.3, {0, 2.0 * i, 0})));
  map.add({{}, {}, {{{1, 2, 3}, 1}, {{2, 2, 3}, 1}}, false});
  SeenByPage seen;
  const Read got = read(map.lackedBy(seen, 1 << 20));
  EXPECT_EQ(got.map_points, map.points());
  EXPECT_EQ(got.map_points, 5000U);
  EXPECT_EQ(got.path_points, 2U);
}

TEST(LiveMap, theFirstPointsOfAMessageAreAFairSample)
{
  constexpr std::size_t kPoints = 10000, kFirst = 500, kWide = 100;
  PlacedCloud placed;
  for (std::size_t i = 0; i < kPoints; ++i)
  {
    placed.points.positions.emplace_back(static_cast<float>(i / kWide), static_cast<float>(i % kWide), 0.0F);
    placed.points.t.push_back(0);
    placed.points.reflectivity.push_back(0);
    placed.points.lidar.push_back(0);
  }
  LiveMap map;
  map.add(keyframe(std::move(placed)));
  SeenByPage seen;
  const std::string messages = map.lackedBy(seen, 1 << 20);
  // The last message is the map's; of its first points as many are on the left as on the right.
  const std::size_t first = messages.size() - 8 * kPoints;
  std::size_t left = 0;
  for (std::size_t i = 0; i < kFirst; ++i)
  {
    std::int16_t cm = 0;
    std::memcpy(&cm, messages.data() + first + 8 * i, sizeof cm);
    left += cm < 100 * static_cast<int>(kPoints / kWide / 2);
  }
  EXPECT_NEAR(static_cast<double>(left), kFirst / 2.0, 5 * std::sqrt(kFirst) / 2);
}

TEST(LiveMap, aPageGetsEachPointOnce)
{
  LiveMap map;
  SeenByPage seen;
  std::size_t got = 0;
  for (int i = 0; i < 20; ++i)
  {
    map.add(keyframe(cloud(1000, 0.3, {0, 2.0 * i, 0})));
    got += read(map.lackedBy(seen, 3000)).map_points;
  }
  for (int i = 0; i < 100; ++i) got += read(map.lackedBy(seen, 3000)).map_points;
  EXPECT_EQ(got, map.points());
}

TEST(LiveMap, aPartIsHardlyLargerThanItMayBe)
{
  LiveMap map;
  map.add(keyframe(cloud(100000, 0.3)));
  SeenByPage seen;
  EXPECT_LT(map.lackedBy(seen, 5000).size(), 5000U + 200U);
}

TEST(LiveMap, pointsAreOfACentimetreFarFromTheOrigin)
{
  LiveMap map;
  map.add(keyframe(cloud(1, 0.5, {12345.678, -54321.012, 432.1})));
  SeenByPage seen;
  const Read got = read(map.lackedBy(seen, 1 << 20));
  EXPECT_NEAR(got.last_point.x(), 12345.678, 0.006);
  EXPECT_NEAR(got.last_point.y(), -54321.012, 0.006);
  EXPECT_NEAR(got.last_point.z(), 432.6, 0.006);
}

TEST(LiveMap, becomesCoarserWhenThereAreTooManyPoints)
{
  LiveMap map;
  SeenByPage seen;
  const std::uint32_t before = read(map.lackedBy(seen, 1 << 20)).map_epoch;
  for (int i = 0; i < 6; ++i) map.add(keyframe(cloud(250000, 0.16, {0, 0, 50.0 * i})));
  EXPECT_LE(map.points(), LiveMap::kMostPoints);
  EXPECT_GT(map.points(), LiveMap::kMostPoints / 10);
  const Read got = read(map.lackedBy(seen, 64 << 20));
  EXPECT_GT(got.map_epoch, before);
  EXPECT_EQ(got.map_points, map.points());
}

TEST(LiveMap, aPageGetsTheNewestScanOnly)
{
  LiveMap map;
  SeenByPage seen;
  for (int i = 0; i < 3; ++i) map.add({{cloud(10, 1)}, {}, {}, false});
  EXPECT_EQ(read(map.lackedBy(seen, 1000)).scans, 1U);
  EXPECT_EQ(read(map.lackedBy(seen, 1000)).scans, 0U);
}

TEST(LiveMap, leavesOutPointsThatAreNoNumbersOrTooFar)
{
  PlacedCloud placed = cloud(3, 1);
  placed.points.positions[0].x() = std::numeric_limits<float>::quiet_NaN();
  placed.points.positions[1].x() = 1e6F;
  LiveMap map;
  map.add(keyframe(placed));
  SeenByPage seen;
  EXPECT_EQ(read(map.lackedBy(seen, 1 << 20)).map_points, 1U);
}

TEST(LiveMap, pathIsBounded)
{
  LiveMap map;
  std::vector<PathPoint> points(LiveMap::kMostPath + 1000, PathPoint{{1, 1, 1}, 1});
  map.add({{}, {}, points, false});
  SeenByPage seen;
  std::size_t got = 0;
  for (int i = 0; i < 200; ++i) got += read(map.lackedBy(seen, 1)).path_points;
  EXPECT_LE(got, LiveMap::kMostPath);
  EXPECT_GE(got, LiveMap::kMostPath / 3);
}
}  // namespace scanloom::live_map_unittest
