#include "estimation/ndt/LidarInformation.h"
#include "estimation/ndt/Registration.h"

#include <gtest/gtest.h>

#include <random>

namespace scanloom::lidar_information_unittest
{
namespace
{
/** Tufts in the middle of cells of 1 m, from 4 to 10 m around the origin; every other row `ahead` (m), the rest behind.
 */
NdtMap tufts(unsigned seed, double ahead = 0)
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
        const double shift = y % 2 == 0 ? ahead : -ahead;
        for (int i = 0; i < 40; ++i)
          points.push_back(
              (centre + shift * Eigen::Vector3d::UnitX() + Eigen::Vector3d(leaf(random), leaf(random), leaf(random)))
                  .cast<float>());
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

TEST(LidarInformation, whatDeviatesByMoreThanTenMetresIsNotMeasured)
{
  Vector6d deviations;
  deviations << 0.01, 12, 0.01, 0.001, 3, 0.001;  // m, rad: 3 rad are 15 m at 5 m
  const std::vector<Vector6d> open = unmeasuredDirections(deviations.cwiseAbs2().asDiagonal());
  ASSERT_EQ(open.size(), 2);
  EXPECT_NEAR(std::abs(open[0][4]), 1, 1e-12);
  EXPECT_NEAR(std::abs(open[1][1]), 1, 1e-12);
  EXPECT_TRUE(unmeasuredDirections(Matrix6d::Identity()).empty());
}

TEST(LidarInformation, whereTwoMinimaMeetThePriorIsKeptAndTheDirectionIsOpen)
{
  const double half = 0.3;  // m: one half of the tufts moved forwards, the other half backwards
  Vector6d deviations = Vector6d::Constant(0.001);
  deviations[0] = 0.005;
  const PoseGuess guess(Rigid::fromXyzYawPitchRoll(0.004, 0, 0, 0, 0, 0), deviations.cwiseAbs2().asDiagonal());
  const RegistrationResult seen = align(tufts(3), tufts(4, half), guess, {});
  EXPECT_EQ(seen.outcome, Outcome::Degenerate);
  EXPECT_NEAR(seen.target_T_source.translation.x(), 0.004, 1e-6);
}
}  // namespace scanloom::lidar_information_unittest
