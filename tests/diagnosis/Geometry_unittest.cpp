/** GroundPlane and SelfReturns in worlds of planes and stems. */
#include "calibration/CloudAgreement.h"
#include "calibration/seenInWorld.h"
#include "diagnosis/internal/GroundFinding.h"
#include "diagnosis/internal/SelfReturns.h"
#include "estimation/imu/MeanForce.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::geometry_unittest
{
using Tilts = testing::TestWithParam<double>;

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
  EXPECT_LT(degreesBetween(ground->up, Eigen::Vector3d::UnitZ()), 1)
      << "a wall or the ceiling was taken for the ground";
}

TEST(GroundFinding, aPlaneOverheadMayBeACeiling)
{
  const GroundPlane overhead{-Eigen::Vector3d::UnitZ(), 0.6, 2.6, 0.4};
  const Finding finding = groundFinding({"top", {}}, overhead);
  EXPECT_EQ(finding.verdict, Verdict::Warning);
  EXPECT_NE(finding.mend.find("unless that plane is a ceiling"), std::string::npos) << finding.mend;
}

namespace
{
/** A wall of 20 m x 4 m, 1.4 m to the left, and this many metres of a path along it, 1.4 m below the sensor. */
PointCloud besideAWall(float path)
{
  std::vector<Eigen::Vector3f> points;
  for (float x = -10; x < 10; x += 0.25F)
  {
    for (float z = -1.4F; z < 2.6F; z += 0.25F) points.emplace_back(x, 1.4F, z);
    for (float y = -0.6F; y < 1.4F; y += 0.25F)
      if (std::abs(x) < path / 2) points.emplace_back(x, y, -1.4F);
  }
  PointCloud cloud;
  cloud.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    cloud.x[i] = points[i].x(), cloud.y[i] = points[i].y(), cloud.z[i] = points[i].z();
  return cloud;
}
}  // namespace

TEST(GroundPlane, thatIsUprightMayBeAWallIfALevelOneIsSeenToo)
{
  const PointCloud with_path = besideAWall(8), without = besideAWall(0);
  const auto ground = groundPlane({&with_path}, Eigen::Vector3d::Zero());
  ASSERT_TRUE(ground);
  EXPECT_TRUE(ground->may_be_a_wall);
  const Finding finding = groundFinding({"top", {}}, ground);
  EXPECT_EQ(finding.verdict, Verdict::Warning);
  EXPECT_NE(finding.mend.find("unless that plane is a wall"), std::string::npos) << finding.mend;
  EXPECT_EQ(groundFinding({"top", {}}, groundPlane({&without}, Eigen::Vector3d::Zero())).verdict, Verdict::NotFit);
}

TEST(GroundPlane, isNotThatOfALevelBeam)
{
  PointCloud ring;
  ring.resize(400);
  for (std::size_t i = 0; i < ring.size(); ++i)
    ring.x[i] = 8 * std::cos(static_cast<float>(i)), ring.y[i] = 8 * std::sin(static_cast<float>(i));
  EXPECT_FALSE(groundPlane({&ring}, Eigen::Vector3d::Zero()));
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
/** Turns seen at these places along x, with a pole on the machine, and a bonnet of this radius. */
std::vector<PointCloud> drive(const std::vector<double>& places, double bonnet = 0)
{
  const Rigid pose = at(0, 0, 0.5);
  std::vector<PointCloud> turns;
  for (const double x : places)
  {
    RayWorld world = forest(3, 400);
    world.stems.push_back({{x + 0.8, 0.3}, 0.1});
    if (bonnet > 0) world.stems.push_back({{x - 1.2, 0}, bonnet});
    turns.push_back(seen(world, at(x, 0, 0), pose, pose, turns.size()));
  }
  return turns;
}

SelfReturns partsIn(const std::vector<PointCloud>& turns, const CropOptions& crop = {})
{
  std::vector<const PointCloud*> clouds;
  for (const PointCloud& turn : turns) clouds.push_back(&turn);
  return selfReturns(clouds, groundPlane({clouds.front()}, {0, 0, 0.5}), cropOf(crop));
}
}  // namespace

TEST(SelfReturns, areWhatDrivesAlong)
{
  const std::vector<PointCloud> turns = drive({0, 2, 4, 6, 8, 10});
  const SelfReturns parts = partsIn(turns);
  ASSERT_TRUE(parts.known);
  std::size_t own = 0, pole = 0, found = 0;
  const PointCloud& cloud = turns[3];
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const bool is_pole =
        std::hypot(cloud.x[i] - 0.8, cloud.y[i] - 0.3) < 0.15 && cloud.z[i] > -1.4;  // above the ground's margin
    own += parts.marks[3][i];
    pole += is_pole ? 1 : 0;
    found += is_pole && parts.marks[3][i] ? 1 : 0;
  }
  ASSERT_GT(pole, 100u);
  EXPECT_GT(static_cast<double>(found) / static_cast<double>(pole), 0.97);
  EXPECT_LT(static_cast<double>(own - found) / static_cast<double>(cloud.size()), 0.02);
  EXPECT_EQ(surroundings({cloud, parts.marks[3]}).size(), cloud.size() - own);
}

TEST(SelfReturns, mayBeMostOfWhatIsNear)
{
  const SelfReturns parts = partsIn(drive({0, 2, 4, 6, 8, 10}, 0.9));  // the bonnet fills half of the view
  ASSERT_TRUE(parts.known);
  EXPECT_GT(parts.share, 0.3);
}

TEST(SelfReturns, areNotToldWhileTheMachineStands)
{
  const SelfReturns parts = partsIn(drive({0, 0, 0, 0, 0, 0}));
  EXPECT_FALSE(parts.known);
  EXPECT_TRUE(parts.marks.empty());
}

TEST(SelfReturns, areNotTheStemsBesideAMachineThatStoodBeforeItDrove)
{
  const std::vector<double> stood_mostly{0, 0, 0, 0, 0, 0, 0, 2, 4, 6};
  const SelfReturns parts = partsIn(drive(stood_mostly));
  ASSERT_TRUE(parts.known);
  EXPECT_LT(parts.box.max().x(), 1.2) << "the pole is at 0.8 m";
  EXPECT_FALSE(partsIn(drive({0, 0, 0, 0, 0, 2})).known) << "too few places";
}

TEST(SelfReturns, haveOneBoxThatRemovesThemForAllLidars)
{
  const SelfReturns left = partsIn(drive({0, 2, 4, 6, 8, 10}, 0.9));
  SelfReturns right = left;
  right.box = Eigen::AlignedBox3d(Eigen::Vector3d(-1, -2, 0), Eigen::Vector3d(3, 0, 1));
  const SelfReturns machine = together({left, right}, {1000, 1000});
  EXPECT_TRUE(machine.box.contains(left.box));
  EXPECT_TRUE(machine.box.contains(right.box));
  EXPECT_NEAR(machine.share, left.share, 1e-9);
  const Finding finding = cropFinding(machine);
  EXPECT_EQ(finding.verdict, Verdict::Warning);
  EXPECT_THAT(finding.mend, testing::HasSubstr("max_x = 3.0"));
}

TEST(SelfReturns, areNoFindingWhereCropRemovesThem)
{
  CropOptions crop;
  crop.min_x = -2.5, crop.max_x = 1.5, crop.min_y = -1.5, crop.max_y = 1.5, crop.min_z = -3, crop.max_z = 9;
  const SelfReturns parts = partsIn(drive({0, 2, 4, 6, 8, 10}, 0.9), crop);
  EXPECT_GT(parts.share, 0.3);
  EXPECT_LT(parts.uncropped, 0.02);
  EXPECT_EQ(cropFinding(parts).verdict, Verdict::Ok);
}
}  // namespace scanloom::geometry_unittest
