#include "estimation/ndt/LidarInformation.h"

#include <gtest/gtest.h>

#include <random>

namespace scanloom::lidar_information_unittest
{
namespace
{
/** Tufts in the middle of cells of 1 m, from 4 to 10 m around the origin. */
NdtMap tufts(unsigned seed)
{
  std::mt19937_64 random(seed);
  std::normal_distribution<double> leaf(0, 0.12);  // m
  std::vector<Eigen::Vector3f> points;
  for (int x = -10; x < 10; ++x)
    for (int y = -10; y < 10; ++y)
      for (int z = -1; z <= 1; ++z)
      {
        const Eigen::Vector3d centre(x + 0.5, y + 0.5, z + 0.5);
        if ((7 * x + 3 * y + 5 * z) % 4 != 0 || centre.norm() < 4 || centre.norm() > 10) continue;
        for (int i = 0; i < 40; ++i)
          points.push_back((centre + Eigen::Vector3d(leaf(random), leaf(random), leaf(random))).cast<float>());
      }
  return {points, NdtOptions{}};
}

LidarInformation informationAt(double x)
{
  const NdtMap map = tufts(3), scan = tufts(4);
  const double d2 = 1;
  const Rigid pose = Rigid::fromXyzYawPitchRoll(x, 0, 0, 0, 0, 0);
  CellCorrespondences correspondences(map, scan, 27);
  correspondences.moveTo(pose);
  return lidarInformation(correspondences, pose, d2);
}
}  // namespace

TEST(LidarInformation, whereTheScoreIsFlatTheViewpointBiasIsStillLessThanACell)
{
  for (double x = 0; x < 0.6; x += 0.01) EXPECT_LT(informationAt(x).viewpoint_bias.norm(), 1) << x;
}
}  // namespace scanloom::lidar_information_unittest
