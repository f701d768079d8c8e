#include "mrpt/maps/SimpleMapFile.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/observations/CGenericPointsMap.h"
#include "mrpt/observations/registerClasses.h"
#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationPointCloud.h>

namespace scanloom::simple_map_file_unittest
{
namespace
{
const Rigid kBodyTLeft = Rigid::fromXyzYawPitchRoll(1.5, 1.2, 2.5, 0.5, 0.2, -0.4);
const Rigid kBodyTRight = Rigid::fromXyzYawPitchRoll(1.5, -1.2, 2.5, -0.5, 0.2, 0.4);

std::vector<MountedLidar> twoLidars() { return {{"left", kBodyTLeft}, {"right", kBodyTRight}}; }

Keyframe onePointOfEach()
{
  Keyframe keyframe{fromNanoseconds(1'750'000'000'000'000'100), Rigid::fromXyzYawPitchRoll(7, 8, 9, 1, 0, 0), {}};
  keyframe.points.resize(2);
  keyframe.points.x = {4, 5};
  keyframe.points.intensity = {51, 255};
  keyframe.points.sensor_id = {0, 1};
  return keyframe;
}

TEST(SimpleMapBuilder, writesWhatMrptReadsBack)
{
  const TemporaryFolder folder;
  SimpleMapBuilder builder(twoLidars(), CloudClass::CPointsMapXYZI);
  builder.add(onePointOfEach());
  builder.write(folder / "keyframes.simplemap");

  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile((folder / "keyframes.simplemap").string()));
  ASSERT_EQ(map.size(), 1U);
  EXPECT_LT(boxMinus(fromMrpt(map.begin()->pose->getMeanVal()), onePointOfEach().map_T_body).norm(), 1e-9);
  const auto frame = map.begin()->sf;
  ASSERT_EQ(frame->size(), 2U);

  const auto right = frame->getObservationByIndexAs<mrpt::obs::CObservationPointCloud::Ptr>(1);
  EXPECT_EQ(right->sensorLabel, "right");
  EXPECT_EQ(fromMrpt(right->timestamp), onePointOfEach().stamp);
  const auto cloud = std::dynamic_pointer_cast<mrpt::maps::CPointsMapXYZI>(right->pointcloud);
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->size(), 1U);
  EXPECT_FLOAT_EQ(cloud->getPointIntensity(0), 1.0F);
  Eigen::Vector3d p;
  cloud->getPoint(0, p.x(), p.y(), p.z());
  EXPECT_LT((fromMrpt(right->sensorPose) * p - Eigen::Vector3d(5, 0, 0)).norm(), 1e-6) << "sensorPose * point is body";
}

TEST(SimpleMapBuilder, writesTheClassWithAllFieldsUnlessAskedForTheOther)
{
  const TemporaryFolder folder;
  registerClasses();
  SimpleMapBuilder builder(twoLidars());
  builder.add(onePointOfEach());
  builder.write(folder / "keyframes.simplemap");
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile((folder / "keyframes.simplemap").string()));
  const auto right = map.begin()->sf->getObservationByIndexAs<mrpt::obs::CObservationPointCloud::Ptr>(1);
  const auto cloud = std::dynamic_pointer_cast<mrpt::maps::CGenericPointsMap>(right->pointcloud);
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->size(), 1U);
  EXPECT_EQ(cloud->getPointsBufferRef_float_field("intensity")->at(0), 255);
  EXPECT_EQ(cloud->getPointsBufferRef_float_field("t")->at(0), 0) << "deskewed";
}

TEST(SimpleMapBuilder, writesTheSameBytesForTheSameKeyframes)
{
  const TemporaryFolder folder;
  for (const char* name : {"a", "b"})
  {
    SimpleMapBuilder builder(twoLidars());
    builder.add(onePointOfEach());
    builder.write(folder / name);
  }
  EXPECT_EQ(contentOf(folder / "a"), contentOf(folder / "b"));
}

TEST(SimpleMapBuilder, refusesAPointOfAnUnknownLidar)
{
  SimpleMapBuilder builder({twoLidars().front()});
  EXPECT_THROW(builder.add(onePointOfEach()), std::invalid_argument);
}
}  // namespace
}  // namespace scanloom::simple_map_file_unittest
