#include "mrpt/maps/internal/RayInsertion.h"

#include <gtest/gtest.h>

#include <random>

namespace scanloom::ray_insertion_unittest
{
namespace
{
octomap::Pointcloud scatteredCloud(unsigned seed, int points = 3000)
{
  std::mt19937 random(seed);
  const auto coordinate = [&] { return 0.001F * static_cast<float>(static_cast<int>(random() % 40'000) - 20'000); };
  octomap::Pointcloud cloud;
  for (int i = 0; i < points; ++i) cloud.push_back(coordinate(), coordinate(), 0.2F * coordinate());
  return cloud;
}

octomap::point3d originOf(unsigned scan) { return {static_cast<float>(scan), 0.3F, 1.5F}; }

struct TwoTrees
{
  explicit TwoTrees(double resolution) : ours(resolution), stock(resolution) {}
  octomap::OcTree ours, stock;

  void insert(const octomap::Pointcloud& cloud, const octomap::point3d& origin, double max_range)
  {
    insertRays(ours, cloud, origin, max_range);
    stock.insertPointCloud(cloud, origin, max_range, true, true);
  }
  void updateInnerNodes()
  {
    ours.updateInnerOccupancy();
    stock.updateInnerOccupancy();
  }
};

TEST(RayInsertion, givesTheTreeOfOctomapsOwnInsertion)
{
  TwoTrees trees(0.2);
  for (unsigned scan = 0; scan < 3; ++scan) trees.insert(scatteredCloud(scan), originOf(scan), 15);
  trees.updateInnerNodes();

  EXPECT_GT(trees.stock.size(), 100'000U);
  EXPECT_EQ(trees.ours.size(), trees.stock.size());
  EXPECT_TRUE(trees.ours == trees.stock) << "structure and log odds";
}

TEST(RayInsertion, givesTheSameTreeWhereManyThreadsShareTheRays)
{
  TwoTrees trees(0.4);
  trees.insert(scatteredCloud(7, 60'000), originOf(0), 18);
  trees.updateInnerNodes();

  EXPECT_TRUE(trees.ours == trees.stock);
}

TEST(RayInsertion, expandsWhatWasPrunedAsOctomapDoes)
{
  TwoTrees trees(0.2);
  for (int again = 0; again < 12; ++again)  // until log odds are at their bounds
    trees.insert(scatteredCloud(1), originOf(0), 15);
  trees.updateInnerNodes();
  trees.ours.prune();
  trees.stock.prune();
  const std::size_t pruned = trees.stock.size();
  ASSERT_EQ(trees.ours.size(), pruned);

  trees.insert(scatteredCloud(2), originOf(1), 15);
  trees.updateInnerNodes();
  EXPECT_GT(trees.stock.size(), pruned);
  EXPECT_EQ(trees.ours.size(), trees.stock.size());
  EXPECT_TRUE(trees.ours == trees.stock);
}

TEST(RayInsertion, followsRaysAlongTheAxesAndWithinAVoxel)
{
  TwoTrees trees(0.1);
  octomap::Pointcloud cloud;
  for (const float side : {-1.0F, 1.0F})
  {
    cloud.push_back(side * 5, 0, 0);
    cloud.push_back(0, side * 5, 0);
    cloud.push_back(0, 0, side * 5);
  }
  cloud.push_back(0.01F, 0.02F, 0.03F);
  trees.insert(cloud, {0, 0, 0}, 20);
  trees.insert(cloud, {0.05F, 0.05F, 0.05F}, 20);
  trees.updateInnerNodes();

  EXPECT_TRUE(trees.ours == trees.stock);
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
}  // namespace scanloom::ray_insertion_unittest
