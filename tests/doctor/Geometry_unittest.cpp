/** GroundPlane, OwnParts, CommonView and CloudAgreement in worlds of planes and stems, with poses that are wrong by a
 * known amount. */
#include <gtest/gtest.h>

#include <cmath>

#include "core/So3.h"
#include "doctor/CloudAgreement.h"
#include "doctor/CommonView.h"
#include "doctor/OwnParts.h"
#include "imu/MeanForce.h"
#include "ndt/RayWorld.h"

using namespace scanloom;

namespace
{
constexpr double kDegree = M_PI / 180;

/** A cloud in the body frame; rings count from the highest beam, as RayLidar's do. */
PointCloud cloudIn(const Rigid& body_T_sensor, const std::vector<Eigen::Vector3f>& in_sensor)
{
  PointCloud cloud;
  cloud.resize(in_sensor.size());
  for (std::size_t i = 0; i < in_sensor.size(); ++i)
  {
    const Eigen::Vector3d p = body_T_sensor * in_sensor[i].cast<double>();
    cloud.x[i] = static_cast<float>(p.x());
    cloud.y[i] = static_cast<float>(p.y());
    cloud.z[i] = static_cast<float>(p.z());
    const double altitude = std::atan2(in_sensor[i].z(), in_sensor[i].head<2>().norm());
    cloud.ring[i] = static_cast<std::uint16_t>(std::lround((0.78 - altitude) / (2 * 0.78 / 63)));
  }
  return cloud;
}

constexpr int kBeams = 64;

RayLidar lidar()
{
  RayLidar lidar;
  lidar.beams = kBeams;
  return lidar;
}

Rigid at(double x, double y, double z, double yaw_deg = 0, double pitch_deg = 0, double roll_deg = 0)
{
  return Rigid::fromXyzYawPitchRoll(x, y, z, yaw_deg * kDegree, pitch_deg * kDegree, roll_deg * kDegree);
}

PointCloud seen(const RayWorld& world, const Rigid& world_T_body, const Rigid& true_pose, const Rigid& believed_pose,
                std::uint64_t seed)
{
  return cloudIn(believed_pose, scanFrom(world, world_T_body * true_pose, seed, lidar()));
}
}  // namespace

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
std::vector<RigSnapshot> drive(double step, std::size_t snapshots = 6)
{
  const Rigid pose = at(0, 0, 0.5);
  std::vector<RigSnapshot> taken;
  for (std::size_t k = 0; k < snapshots; ++k)
  {
    RayWorld world = forest(3, 400);
    const double x = step * static_cast<double>(k);
    world.stems.push_back({{x + 0.8, 0.3}, 0.1});
    RigSnapshot snapshot(1);
    snapshot[0].points = seen(world, at(x, 0, 0), pose, pose, k);
    taken.push_back(std::move(snapshot));
  }
  return taken;
}
}  // namespace

TEST(OwnParts, areWhatDrivesAlong)
{
  auto snapshots = drive(2);
  const auto ground = groundPlane({&snapshots[0][0].points}, {0, 0, 0.5});
  const OwnParts parts = markOwnParts(snapshots, 0, ground);
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

TEST(OwnParts, areNotToldWhileTheMachineStands)
{
  auto snapshots = drive(0);
  const auto ground = groundPlane({&snapshots[0][0].points}, {0, 0, 0.5});
  EXPECT_FALSE(markOwnParts(snapshots, 0, ground).known);
  EXPECT_TRUE(snapshots[0][0].own.empty());
}

TEST(CommonView, ofTheSamePlaceAgreesAndOfAnotherDoesNot)
{
  const RayWorld world = forest(1);
  const Rigid left = at(0, 1, 0), right = at(0, -1, 0);
  const PointCloud a = seen(world, {}, left, left, 1), b = seen(world, {}, right, right, 2);
  const CommonView good = commonView(a, {}, b, right);
  ASSERT_GT(good.common, 1000u);
  EXPECT_GT(static_cast<double>(good.near) / static_cast<double>(good.common), 0.85);
  const CommonView lifted = commonView(a, at(0, 0, 0.8), b, right);
  EXPECT_LT(static_cast<double>(lifted.near) / static_cast<double>(lifted.common), 0.3);
}

namespace
{
struct Wrong
{
  const char* name;
  Rigid true_in_believed;  // how the believed pose is wrong: true = believed * this
};
void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.name; }
}  // namespace

class WrongPoses : public testing::TestWithParam<Wrong>
{
};

TEST_P(WrongPoses, areFoundByRegistrationToTheOtherLidar)
{
  const Rigid left = at(0.3, 1, 0.5, 30, 15, -25), right = at(0.3, -1, 0.5, -30, 15, 25);
  const Rigid believed = right * GetParam().true_in_believed.inverse();
  std::vector<RigSnapshot> taken;
  for (int k = 0; k < 4; ++k)
  {
    const RayWorld world = forest(static_cast<std::uint64_t>(10 + k));
    RigSnapshot snapshot(2);
    snapshot[0].points = seen(world, {}, left, left, static_cast<std::uint64_t>(k));
    snapshot[1].points = seen(world, {}, right, believed, static_cast<std::uint64_t>(100 + k));
    taken.push_back(std::move(snapshot));
  }
  std::vector<SnapshotPair> pairs;
  for (const RigSnapshot& snapshot : taken) pairs.push_back({&snapshot[1], &snapshot[0]});

  const auto agreement = cloudAgreement(pairs, believed, left);
  ASSERT_TRUE(agreement && agreement->correction);
  const Eigen::Vector3d offset = right.translation - believed.translation;
  const Eigen::Vector3d rotation = logSo3(right.rotation * believed.rotation.conjugate());
  EXPECT_LT((agreement->correction->offset - offset).norm(), 0.03);
  EXPECT_LT((agreement->correction->rotation - rotation).norm() / kDegree, 0.3);
  EXPECT_GT(agreement->correction->near_share, 0.85);
}

INSTANTIATE_TEST_SUITE_P(FromNoneToFiveDegreesAndThirtyCentimetres, WrongPoses,
                         testing::Values(Wrong{"none", {}}, Wrong{"yaw", at(0, 0, 0, 5)},
                                         Wrong{"roll and forward", at(0.3, 0, 0, 0, 0, 5)},
                                         Wrong{"sideways", at(0, 0.3, 0)},
                                         Wrong{"all", at(-0.2, 0.15, 0.15, 3, -3, 2)}),
                         [](const auto& wrong)
                         {
                           std::string name = wrong.param.name;
                           for (char& c : name)
                             if (c == ' ') c = '_';
                           return name;
                         });

TEST(CloudAgreement, ofLidarsThatSeeNothingInCommonIsNone)
{
  const Rigid pose;
  RigSnapshot snapshot(2);
  snapshot[0].points = seen(forest(1), {}, pose, pose, 1);
  EXPECT_FALSE(cloudAgreement({{&snapshot[1], &snapshot[0]}}, pose, pose));
  EXPECT_FALSE(cloudAgreement({}, pose, pose));
}
