#include "estimation/ndt/internal/PointCells.h"

#include "estimation/ndt/internal/KeyIndex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

namespace scanloom::point_cells_unittest
{
namespace
{
constexpr std::int64_t kEdge = 16385;  // quanta: odd, about 0.25 m

std::vector<float> coordinates(std::size_t count)
{
  std::mt19937_64 random(1);
  std::normal_distribution<float> normal(0, 30);
  std::vector<float> values;
  for (std::size_t i = 0; i < 3 * count; ++i) values.push_back(normal(random));
  for (const float edge : {0.0f, -0.0f, 0.25f, -0.25f, 1e-8f, -1e-8f, 8388608.0f, -1e30f,
                           std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    for (int axis = 0; axis < 3; ++axis) values.push_back(axis == 0 ? edge : 1.0f);
  return values;
}

Coordinates triples(const std::vector<float>& values)
{
  return {values.data(), values.data() + 1, values.data() + 2, 3, values.size() / 3};
}

std::int64_t floorDivision(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

TEST(PointCells, areThoseOfIntegerDivisionForEveryKernelAndAnyNumberOfPoints)
{
  const auto values = coordinates(300);
  const std::int64_t centre = PointCells::centreOf(kEdge);
  for (const Kernel kernel : runnableKernels())
    for (const std::size_t count : {values.size() / 3, std::size_t{1}, std::size_t{9}})
    {
      const Coordinates points = triples(values).part(values.size() / 3 - count, count);
      const PointCells located = locate(points, kEdge, Eigen::Matrix3d::Identity(), kernel);
      for (std::size_t i = 0; i < points.count; ++i)
      {
        const float x = points.x[3 * i], y = points.y[3 * i], z = points.z[3 * i];
        if (!(std::abs(x) < 262144))  // 2^20 - 1 cells of a quarter of a metre
        {
          EXPECT_EQ(located.key[i], PointCells::kNowhere) << x;
          continue;
        }
        const auto quanta = [](float v) { return std::llrint(static_cast<double>(v) / Moments::kQuantum); };
        const std::int64_t qx = quanta(x), qy = quanta(y), qz = quanta(z);
        const std::int64_t cx = floorDivision(qx, kEdge), cy = floorDivision(qy, kEdge), cz = floorDivision(qz, kEdge);
        EXPECT_EQ(located.key[i], CellKey::of(cx, cy, cz));
        EXPECT_EQ(located.x[i], static_cast<double>(qx - cx * kEdge - centre));
        EXPECT_EQ(located.y[i], static_cast<double>(qy - cy * kEdge - centre));
        EXPECT_EQ(located.z[i], static_cast<double>(qz - cz * kEdge - centre));
      }
    }
}

TEST(PointCells, ofATurnedGridAreThoseOfTurnedPointsForEveryKernel)
{
  // Exact: a third of a turn about a diagonal of the cubes.
  const Eigen::Matrix3d turn = (Eigen::Matrix3d() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished();
  const auto values = coordinates(300);
  std::vector<float> turned;
  for (std::size_t i = 0; i < values.size(); i += 3)
    for (const float v : {-values[i + 1], -values[i + 2], values[i]}) turned.push_back(v);
  for (const Kernel kernel : runnableKernels())
  {
    const PointCells by_locate = locate(triples(values), kEdge, turn, kernel);
    const PointCells before = locate(triples(turned), kEdge, Eigen::Matrix3d::Identity(), kernel);
    for (std::size_t i = 0; i < values.size() / 3; ++i)
    {
      EXPECT_EQ(by_locate.key[i], before.key[i]);
      if (before.key[i] == PointCells::kNowhere) continue;
      EXPECT_EQ(by_locate.x[i], before.x[i]);
      EXPECT_EQ(by_locate.y[i], before.y[i]);
      EXPECT_EQ(by_locate.z[i], before.z[i]);
    }
  }
}

TEST(KeyIndex, numbersKeysInTheOrderOfTheirFirstUseHoweverMany)
{
  std::mt19937_64 random(2);
  KeyIndex index;
  std::map<std::uint64_t, std::uint32_t> expected;
  for (int i = 0; i < 100000; ++i)
  {
    const std::uint64_t key = random() % 30000;
    const auto place = expected.try_emplace(key, static_cast<std::uint32_t>(expected.size())).first->second;
    ASSERT_EQ(index.placeOf(key), place);
  }
  EXPECT_EQ(index.keys().size(), expected.size());
}
}  // namespace
}  // namespace scanloom::point_cells_unittest
