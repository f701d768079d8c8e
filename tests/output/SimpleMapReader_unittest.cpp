#include "output/SimpleMapReader.h"

#include "mrpt_bridge/Conversions.h"
#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

namespace scanloom
{
namespace
{
/** As another program of MRPT's would make it: no intensity, one cloud, a pose of its own. */
void addForeign(mrpt::maps::CSimpleMap& map, const mrpt::poses::CPose3D& robot, const mrpt::poses::CPose3D& sensor)
{
  auto points = mrpt::maps::CSimplePointsMap::Create();
  points->insertPoint(1.0F, 2.0F, 3.0F);
  auto observation = mrpt::obs::CObservationPointCloud::Create();
  observation->sensorLabel = "front";
  observation->sensorPose = sensor;
  observation->pointcloud = points;
  mrpt::obs::CSensoryFrame frame;
  frame.insert(observation);
  map.insert(mrpt::poses::CPose3DPDFGaussian(robot), frame);
}

TEST(SimpleMapReader, readsWhatAnotherProgramWrote)
{
  const TemporaryFolder folder;
  mrpt::maps::CSimpleMap map;
  addForeign(map, {7, 8, 9, M_PI / 2, 0, 0}, {0, 0, 2, 0, 0, 0});
  ASSERT_TRUE(map.saveToFile((folder / "foreign.simplemap").string()));

  const SimpleMapReader reader(folder / "foreign.simplemap");
  ASSERT_EQ(reader.size(), 1U);
  ASSERT_EQ(reader.lidars().size(), 1U);
  EXPECT_EQ(reader.lidars()[0].name, "front");
  const Keyframe keyframe = reader.keyframe(0);
  EXPECT_EQ(keyframe.points.position(0), Eigen::Vector3f(1, 2, 5)) << "in the body frame";
  EXPECT_LT((keyframe.map_T_body * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(7, 9, 9)).norm(), 1e-9);
}

TEST(SimpleMapReader, givesBackWhatTheBuilderWasGiven)
{
  const TemporaryFolder folder;
  const std::vector<MountedLidar> lidars{{"left", Rigid::fromXyzYawPitchRoll(1.5, 1.2, 2.5, 0.5, 0.2, -0.4)},
                                         {"right", Rigid::fromXyzYawPitchRoll(1.5, -1.2, 2.5, -0.5, 0.2, 0.4)}};
  Keyframe written{fromNanoseconds(1'750'000'000'000'000'100), Rigid::fromXyzYawPitchRoll(7, 8, 9, 1, 0, 0), {}};
  written.points.resize(3);
  written.points.x = {4, 5, 6};
  written.points.intensity = {51, 255, 0};
  written.points.sensor_id = {0, 1, 1};
  SimpleMapBuilder builder(lidars);
  builder.add(written);
  builder.write(folder / "keyframes.simplemap");

  const SimpleMapReader reader(folder / "keyframes.simplemap");
  ASSERT_EQ(reader.lidars().size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_EQ(reader.lidars()[i].name, lidars[i].name);
    EXPECT_LT(boxMinus(reader.lidars()[i].body_T_sensor, lidars[i].body_T_sensor).norm(), 1e-9) << "where rays start";
  }
  const Keyframe read = reader.keyframe(0);
  EXPECT_EQ(read.stamp, written.stamp);
  EXPECT_EQ(read.points.sensor_id, written.points.sensor_id);
  EXPECT_EQ(read.points.intensity, written.points.intensity);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT((read.points.position(i) - written.points.position(i)).norm(), 1e-5F);
}

TEST(SimpleMapReader, refusesALidarThatMovedAndFilesThatAreNone)
{
  const TemporaryFolder folder;
  mrpt::maps::CSimpleMap map;
  addForeign(map, {}, {0, 0, 2, 0, 0, 0});
  addForeign(map, {}, {0, 0, 3, 0, 0, 0});
  map.saveToFile((folder / "moved.simplemap").string());
  std::ofstream(folder / "text.simplemap") << "no map";

  EXPECT_THROW(SimpleMapReader(folder / "moved.simplemap"), std::runtime_error);
  EXPECT_THROW(SimpleMapReader(folder / "text.simplemap"), std::runtime_error);
  EXPECT_THROW(SimpleMapReader(folder / "nowhere.simplemap"), std::runtime_error);
}
}  // namespace
}  // namespace scanloom
