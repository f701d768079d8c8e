#include "output/RayInsertion.h"

#include <gtest/gtest.h>

#include <random>

namespace scanloom
{
namespace
{
octomap::Pointcloud scatteredCloud(unsigned seed)
{
  std::mt19937 random(seed);
  const auto coordinate = [&] { return 0.001F * static_cast<float>(static_cast<int>(random() % 40'000) - 20'000); };
  octomap::Pointcloud cloud;
  for (int i = 0; i < 3000; ++i) cloud.push_back(coordinate(), coordinate(), 0.2F * coordinate());
  return cloud;
}

TEST(RayInsertion, givesTheTreeOfOctomapsOwnInsertion)
{
  octomap::OcTree ours(0.2), stock(0.2);
  for (unsigned scan = 0; scan < 3; ++scan)
  {
    const octomap::point3d origin(static_cast<float>(scan), 0.3F, 1.5F);
    insertRays(ours, scatteredCloud(scan), origin, 15);
    stock.insertPointCloud(scatteredCloud(scan), origin, 15, true, true);
  }
  ours.updateInnerOccupancy();
  stock.updateInnerOccupancy();

  EXPECT_GT(stock.size(), 100'000U);
  EXPECT_TRUE(ours == stock) << "structure and log odds";
}

TEST(RayInsertion, leavesOutPointsBeyondTheTree)
{
  octomap::OcTree tree(0.01);  // reaches 327 m
  octomap::Pointcloud cloud;
  cloud.push_back(400, 0, 0);
  insertRays(tree, cloud, {0, 0, 0}, 15);

  EXPECT_EQ(tree.size(), 0U);
}
}  // namespace
}  // namespace scanloom
