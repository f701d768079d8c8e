#include "base/core/VoxelKey.h"

#include <gtest/gtest.h>

namespace scanloom::voxel_key_unittest
{
TEST(VoxelKey, isThatOfTheCubeThatHoldsThePoint)
{
  EXPECT_EQ(voxelKey(Eigen::Vector3f(0.09f, 0.01f, 0), 0.1), voxelKey(0, 0, 0));
  EXPECT_EQ(voxelKey(Eigen::Vector3f(-0.01f, 0.11f, 0.25f), 0.1), voxelKey(-1, 1, 2));
}

TEST(VoxelKey, differsAlongEveryAxisAndAcrossZero)
{
  EXPECT_NE(voxelKey(-1, 0, 0), voxelKey(0, 0, 0));
  EXPECT_NE(voxelKey(0, -1, 0), voxelKey(-1, 0, 0));
  EXPECT_NE(voxelKey(0, 0, -1), voxelKey(0, -1, 0));
}
}  // namespace scanloom::voxel_key_unittest
