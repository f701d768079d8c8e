#include "lab/simulation/internal/Foliage.h"
#include "lab/simulation/internal/Random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::foliage_unittest
{
namespace
{
constexpr double kMaxRange = 60;

/** Nine tiles around the origin, 16 m each, from -2 m to 12 m. */
FoliageVoxels emptyVoxels()
{
  std::vector<GridCell> tiles;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) tiles.push_back({x, y});
  return {0.5, tiles, -2, 12};
}

Foliage somePlants()
{
  FoliageVoxels voxels = emptyVoxels();
  Random random(1, RandomStream::Foliage, 0);
  for (int plant = 0; plant < 40; ++plant)
  {
    const Eigen::Array3i middle =
        voxels.voxelAt({random.uniform(-16, 32), random.uniform(-16, 32), random.uniform(0, 10)});
    for (int i = 0; i < 60; ++i)
    {
      const Eigen::Array3d offset(2 * random.normal(), 2 * random.normal(), 2 * random.normal());
      voxels.add(middle + offset.cast<int>(), i % 2 == 0 ? Surface::Crown : Surface::Undergrowth, random.uniform(0, 1));
    }
  }
  return Foliage(voxels);
}

Ray randomRay(Random& random)
{
  const Eigen::Vector3d origin(random.uniform(-10, 20), random.uniform(-10, 20), random.uniform(0, 5));
  return {origin, Eigen::Vector3d(random.normal(), random.normal(), 0.5 * random.normal()).normalized()};
}

TEST(Foliage, letsLightThroughAsBeerAndLambertSay)
{
  constexpr double kExtinction = 0.3, kThickness = 4;  // 1/m, m
  FoliageVoxels voxels = emptyVoxels();
  for (int z = 0; z < 20; ++z)
    for (int y = -20; y < 20; ++y)
      for (int x = 10; x < 10 + 2 * kThickness; ++x) voxels.add({x, y, z}, Surface::Crown, kExtinction);
  const Foliage hedge(voxels);
  const Ray ray{{0, 0.1, 2.2}, Eigen::Vector3d(1, 0.2, 0.1).normalized()};

  Random random(2, RandomStream::Leaves, 0);
  constexpr int kRays = 100'000;
  int through = 0;
  double depth = 0;
  for (int i = 0; i < kRays; ++i)
  {
    const auto leaf = hedge.intersect({ray, kMaxRange, random.exponential()});
    through += !leaf;
    if (!leaf) continue;
    EXPECT_EQ(leaf->surface, Surface::Crown);
    depth += (ray.at(leaf->range).x() - 5) / ray.direction.x();
  }
  const double length = kThickness / ray.direction.x(), passed = std::exp(-kExtinction * length);
  EXPECT_NEAR(through / double{kRays}, passed, 4 * std::sqrt(passed * (1 - passed) / kRays));
  // Mean of an exponential distribution that is cut off at `length`.
  const double mean = 1 / kExtinction - length * passed / (1 - passed);
  EXPECT_NEAR(depth / (kRays - through), mean, 0.02);
}

/** Skipping open space loses no leaf: compared with small steps along the ray. */
TEST(Foliage, isMetWhereTheSumOfItsExtinctionReachesTheDepth)
{
  const Foliage foliage = somePlants();
  Random random(3, RandomStream::Leaves, 0);
  int met = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const Ray ray = randomRay(random);
    const double wanted = random.exponential();
    const auto leaf = foliage.intersect({ray, kMaxRange, wanted});

    constexpr double kStep = 5e-3;  // m
    const double end = leaf ? leaf->range : kMaxRange;
    double depth = 0;
    for (double range = 0; range < end; range += kStep)
    {
      const Eigen::Array3i voxel = foliage.voxels().voxelAt(ray.at(range + 0.5 * kStep));
      depth += kStep * foliage.voxels().at(voxel.x(), voxel.y(), voxel.z()).extinction();
    }
    met += leaf.has_value();
    EXPECT_LT(depth, wanted + 0.02) << i;
    EXPECT_GT(depth, leaf ? wanted - 0.02 : -1) << i;
  }
  EXPECT_GT(met, 100);
}

TEST(Foliage, isNotMetBeyondTheRange)
{
  const Foliage foliage = somePlants();
  Random random(4, RandomStream::Leaves, 0);
  for (int i = 0; i < 2000; ++i)
  {
    const Ray ray = randomRay(random);
    const double wanted = random.exponential();
    const auto leaf = foliage.intersect({ray, kMaxRange, wanted});
    if (!leaf) continue;
    EXPECT_FALSE(foliage.intersect({ray, 0.999 * leaf->range, wanted}));
    EXPECT_TRUE(foliage.intersect({ray, 1.001 * leaf->range, wanted}));
  }
}

TEST(Foliage, isFoundByRaysAlongTheAxes)
{
  FoliageVoxels voxels = emptyVoxels();
  voxels.add(voxels.voxelAt({8.2, 3.2, 2.2}), Surface::Undergrowth, 2.4);
  const Foliage bush(voxels);

  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0),
        Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1)})
  {
    const Eigen::Vector3d centre(8.25, 3.25, 2.25);
    const auto leaf = bush.intersect({{centre - 2 * direction, direction}, kMaxRange, 0.5 * 2.4 * 0.25});
    ASSERT_TRUE(leaf) << direction.transpose();
    EXPECT_NEAR(leaf->range, 1.75 + 0.125, 1e-9);
    EXPECT_EQ(leaf->surface, Surface::Undergrowth);
  }
}

TEST(FoliageVoxels, knowHowFarTheNextPlantIs)
{
  FoliageVoxels voxels = emptyVoxels();
  const std::vector<Eigen::Array3i> plants{{0, 0, 0}, {-20, 31, 5}, {40, -3, 12}};
  for (const Eigen::Array3i& plant : plants) voxels.add(plant, Surface::Crown, 1);
  voxels.measureOpenSpace();

  for (int z = -4; z < 24; ++z)
    for (int y = -32; y < 64; ++y)
      for (int x = -32; x < 64; ++x)
      {
        int nearest = FoliageVoxel::kFarthest + 1;
        for (const Eigen::Array3i& plant : plants)
          nearest = std::min(nearest, (Eigen::Array3i(x, y, z) - plant).abs().maxCoeff());
        ASSERT_EQ(voxels.at(x, y, z).around(), std::max(0, nearest - 1)) << x << " " << y << " " << z;
      }
}

TEST(FoliageVoxels, keepTheDenserOfTwoPlants)
{
  FoliageVoxels voxels = emptyVoxels();
  voxels.add({1, 2, 3}, Surface::Crown, 0.5);
  voxels.add({1, 2, 3}, Surface::Undergrowth, 0.4);
  EXPECT_EQ(voxels.at(1, 2, 3).surface(), Surface::Crown);
  EXPECT_NEAR(voxels.at(1, 2, 3).extinction(), 0.5, 1e-12);

  voxels.add({1, 2, 3}, Surface::Undergrowth, 0.6);
  EXPECT_EQ(voxels.at(1, 2, 3).surface(), Surface::Undergrowth);
  voxels.add({1000, 0, 0}, Surface::Crown, 0.6);
  EXPECT_TRUE(voxels.at(1000, 0, 0).isEmpty()) << "outside of the tiles";
}
}  // namespace
}  // namespace scanloom::foliage_unittest
