/** GroundPlane and SelfReturns in worlds of planes and stems. */
#include "calibration/seenInWorld.h"
#include "diagnosis/internal/SelfReturns.h"
#include "estimation/imu/MeanForce.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::geometry_unittest
{
class Tilts : public testing::TestWithParam<double>
{
};

TEST_P(Tilts, ofTheGroundAreFoundWithTheSensorsHeight)
{
  const Rigid true_pose = at(0, 0, 0.5), believed = at(0, 0, 0.5, 0, 0, GetParam());
  const PointCloud cloud = seen(openField(), {}, true_pose, believed, 1);  // 2 m below the body's origin
  const auto ground = groundPlane({&cloud}, believed.translation);
  ASSERT_TRUE(ground);
  EXPECT_NEAR(degreesBetween(ground->up, Eigen::Vector3d::UnitZ()), GetParam(), 0.1);
  EXPECT_NEAR(ground->sensor_height, 2.5, 0.01);
  EXPECT_GT(ground->share, 0.95);
}

INSTANTIATE_TEST_SUITE_P(FromLevelToUpsideDown, Tilts, testing::Values(0, 5, 20, 90, 180));

TEST(GroundPlane, isFoundBetweenWalls)
{
  const Rigid pose = at(0, 0, 0.2, 40, 5, -10);
  const PointCloud cloud =
      seen(corridor(), {}, pose, pose, 1);  // floor at -1.6, ceiling at 1.5, walls nearer and larger
  const auto ground = groundPlane({&cloud}, pose.translation);
  ASSERT_TRUE(ground);
  const double tilt = degreesBetween(ground->up, Eigen::Vector3d::UnitZ());
  EXPECT_LT(std::min(tilt, 180 - tilt), 1) << "a wall was taken for the ground";
}

TEST(GroundPlane, isNotFoundInACrown)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-6, 6);
  PointCloud cloud;
  cloud.resize(5000);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    cloud.x[i] = place(random);
    cloud.y[i] = place(random);
    cloud.z[i] = place(random);
  }
  EXPECT_FALSE(groundPlane({&cloud}, Eigen::Vector3d::Zero()));
  EXPECT_FALSE(groundPlane({}, Eigen::Vector3d::Zero()));
}

namespace
{
/** Drives 2 m from snapshot to snapshot, with a pole on its bonnet. */
std::vector<RigSnapshot> drive(double step, std::size_t snapshots = 6, double bonnet = 0)
{
  const Rigid pose = at(0, 0, 0.5);
  std::vector<RigSnapshot> taken;
  for (std::size_t k = 0; k < snapshots; ++k)
  {
    RayWorld world = forest(3, 400);
    const double x = step * static_cast<double>(k);
    world.stems.push_back({{x + 0.8, 0.3}, 0.1});
    if (bonnet > 0) world.stems.push_back({{x - 1.2, 0}, bonnet});
    RigSnapshot snapshot(1);
    snapshot[0].points = seen(world, at(x, 0, 0), pose, pose, k);
    taken.push_back(std::move(snapshot));
  }
  return taken;
}
}  // namespace

TEST(SelfReturns, areWhatDrivesAlong)
{
  auto snapshots = drive(2);
  const auto ground = groundPlane({&snapshots[0][0].points}, {0, 0, 0.5});
  const SelfReturns parts = markSelfReturns(snapshots, 0, ground);
  ASSERT_TRUE(parts.known);
  std::size_t own = 0, pole = 0, found = 0;
  const PointCloud& cloud = snapshots[3][0].points;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const bool is_pole =
        std::hypot(cloud.x[i] - 0.8, cloud.y[i] - 0.3) < 0.15 && cloud.z[i] > -1.4;  // above the ground's margin
    own += snapshots[3][0].own[i];
    pole += is_pole ? 1 : 0;
    found += is_pole && snapshots[3][0].own[i] ? 1 : 0;
  }
  ASSERT_GT(pole, 100u);
  EXPECT_GT(static_cast<double>(found) / static_cast<double>(pole), 0.97);
  EXPECT_LT(static_cast<double>(own - found) / static_cast<double>(cloud.size()), 0.02);
  EXPECT_EQ(surroundings(snapshots[3][0]).size(), cloud.size() - own);
}

TEST(SelfReturns, mayBeMostOfWhatIsNear)
{
  auto snapshots = drive(2, 6, 0.9);  // of this radius: a bonnet that fills half of the view
  const auto ground = groundPlane({&snapshots[0][0].points}, {0, 0, 0.5});
  const SelfReturns parts = markSelfReturns(snapshots, 0, ground);
  ASSERT_TRUE(parts.known);
  EXPECT_GT(parts.share, 0.3);
}

TEST(SelfReturns, areNotToldWhileTheMachineStands)
{
  auto snapshots = drive(0);
  const auto ground = groundPlane({&snapshots[0][0].points}, {0, 0, 0.5});
  EXPECT_FALSE(markSelfReturns(snapshots, 0, ground).known);
  EXPECT_TRUE(snapshots[0][0].own.empty());
}
}  // namespace scanloom::geometry_unittest
