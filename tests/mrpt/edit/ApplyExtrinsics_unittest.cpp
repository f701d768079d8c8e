/** Operations that move points: other extrinsics, a trajectory's motion. */
#include "mrpt/edit/internal/ApplyExtrinsics.h"

#include "base/core/ConfigError.h"
#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/internal/DeskewClouds.h"
#include "mrpt/observations/RawlogInfo.h"
#include "smallRawlog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <fstream>

namespace scanloom::apply_extrinsics_unittest
{
namespace
{
struct ApplyExtrinsics : testing::Test
{
  TemporaryFolder folder;
  std::filesystem::path in = writeSmallRawlog(folder / "in.rawlog");
  std::filesystem::path out = folder / "out.rawlog";

  Eigen::Vector3f point(std::size_t i) const
  {
    return positionsInBody(*cloudIn(observationsIn(out, "lidar").front()))[i];
  }
};

TEST_F(ApplyExtrinsics, movesThePointsOfALidarAndItsImuAndTheHeader)
{
  // The right lidar sits 0.5 m higher than it was said to; its attitude is the same.
  Rigid higher = someHeader().lidars[1].body_T_sensor;
  higher.translation.z() += 0.5;
  edited(in, applyExtrinsics({{"right", higher}}, someHeader()), out);

  EXPECT_LT((point(0) - Eigen::Vector3f(0, 0, 0)).norm(), 1e-6) << "of the left lidar";
  EXPECT_LT((point(4) - Eigen::Vector3f(0.4f, -0.2f, 1.5f)).norm(), 1e-6) << "of the right lidar";
  EXPECT_NEAR(rawlogInfo(out).header->lidars[1].body_T_sensor.translation.z(), 3.0, 1e-12);
  mrpt::poses::CPose3D pose;
  observationsIn(out, "imu_right").front()->getSensorPose(pose);
  EXPECT_NEAR(pose.z(), 3.0, 1e-12) << "this one sits in the lidar's origin";
}

TEST_F(ApplyExtrinsics, turnsPointsAboutTheLidar)
{
  RecordingHeader header = someHeader();
  header.lidars[1].body_T_sensor = Rigid::fromXyzYawPitchRoll(1, 0, 0, 0, 0, 0);
  edited(in, applyExtrinsics({{"right", Rigid::fromXyzYawPitchRoll(1, 0, 0, M_PI / 2, 0, 0)}}, header), out);
  // Point 4 at (0.4, -0.2, 1) is (-0.6, -0.2, 1) from the lidar; a quarter turn to the left makes it (0.2, -0.6, 1).
  EXPECT_LT((point(4) - Eigen::Vector3f(1.2f, -0.6f, 1)).norm(), 1e-6);
}

TEST_F(ApplyExtrinsics, readsPosesOfExtrinsicsAndOfConfigurations)
{
  std::ofstream(folder / "e.txt") << "T_body_left 1 2 3 90 0 0\nT_world_body 0 0 0 0 0 0\n";
  std::ofstream(folder / "e.ini") << "[lidars]\ndriver = CMultiLidarSensor\nprocess_rate = 100\n"
                                     "lidar1_name = left\nlidar1_metadata = x.json\nlidar1_pose = [4 5 6 0 0 90]\n"
                                  << "extrinsics = " << (folder / "e.txt").string() << "\n";
  EXPECT_EQ(readSensorPoses(folder / "e.txt").size(), 1u);
  EXPECT_EQ(readSensorPoses(folder / "e.txt").at("left").translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(readSensorPoses(folder / "e.ini").at("left").translation, Eigen::Vector3d(4, 5, 6));
}

TEST_F(ApplyExtrinsics, posesOfNoSensorAreAMistake)
{
  EXPECT_THROW(applyExtrinsics({{"centre", Rigid::identity()}}, someHeader()), UsageError);
}

TEST_F(ApplyExtrinsics, deskewedPointsAreWhereTheyWereAtTheStart)
{
  edited(in, deskewClouds(straightOn(), someHeader()), out);
  const float moved = 10 * 2.441403e-3f;  // in the time of column 1
  EXPECT_LT((point(4) - Eigen::Vector3f(0.4f + moved, -0.2f, 1)).norm(), 1e-5);
  EXPECT_EQ(observationsIn(out, "lidar").size(), 2u) << "the others are not within the trajectory";
  EXPECT_EQ(observationsIn(out, "imu").size(), 8u);
}
}  // namespace
}  // namespace scanloom::apply_extrinsics_unittest
