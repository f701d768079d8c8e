#include "mrpt/maps/SimpleMapFile.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/maps/SimpleMapReader.h"
#include "mrpt/observations/CGenericPointsMap.h"
#include "mrpt/observations/registerClasses.h"
#include "support/TemporaryFolder.h"
#include "support/peakMemory.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cmath>

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

TEST(SimpleMapWriter, writesWhatMrptReadsBack)
{
  const TemporaryFolder folder;
  SimpleMapWriter writer(folder / "keyframes.simplemap", twoLidars(), CloudClass::CPointsMapXYZI);
  writer.add({onePointOfEach()});
  writer.close();

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

TEST(SimpleMapWriter, writesTheClassWithAllFieldsUnlessAskedForTheOther)
{
  const TemporaryFolder folder;
  registerClasses();
  SimpleMapWriter writer(folder / "keyframes.simplemap", twoLidars());
  writer.add({onePointOfEach()});
  writer.close();
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile((folder / "keyframes.simplemap").string()));
  const auto right = map.begin()->sf->getObservationByIndexAs<mrpt::obs::CObservationPointCloud::Ptr>(1);
  const auto cloud = std::dynamic_pointer_cast<mrpt::maps::CGenericPointsMap>(right->pointcloud);
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->size(), 1U);
  EXPECT_EQ(cloud->getPointsBufferRef_float_field("intensity")->at(0), 255);
  EXPECT_EQ(cloud->getPointsBufferRef_float_field("t")->at(0), 0) << "deskewed";
}

TEST(SimpleMapWriter, givesTheErrorOfThePoseAlongTheMapsAxesAndInItsAngles)
{
  const TemporaryFolder folder;
  SimpleMapWriter writer(folder / "keyframes.simplemap", twoLidars(), CloudClass::CPointsMapXYZI);
  MeasuredKeyframe measured{onePointOfEach()};
  measured.keyframe.map_T_body = Rigid::fromXyzYawPitchRoll(7, 8, 9, M_PI / 2, 0, 0);
  measured.covariance.diagonal() << 0.04, 0.01, 0.09, 1e-4, 4e-4, 9e-4;  // ahead, left, up, about them
  writer.add(measured);
  writer.close();
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile((folder / "keyframes.simplemap").string()));
  const auto covariance = map.begin()->pose->getCovariance();
  EXPECT_NEAR(covariance(0, 0), 0.01, 1e-9) << "x of the map is right of the body";
  EXPECT_NEAR(covariance(1, 1), 0.04, 1e-9);
  EXPECT_NEAR(covariance(2, 2), 0.09, 1e-9);
  EXPECT_NEAR(covariance(3, 3), 9e-4, 1e-9) << "yaw";
  EXPECT_NEAR(covariance(4, 4), 4e-4, 1e-9) << "pitch";
  EXPECT_NEAR(covariance(5, 5), 1e-4, 1e-9) << "roll";
}

TEST(SimpleMapWriter, addsTheReadingOfTheImu)
{
  const TemporaryFolder folder;
  SimpleMapWriter writer(folder / "keyframes.simplemap", twoLidars(), CloudClass::CPointsMapXYZI);
  MeasuredKeyframe measured{onePointOfEach()};
  const ImuSample sample{measured.keyframe.stamp, {0.1, 0.2, 0.3}, {0, 0, 9.81}};
  measured.imu = RecordedImu{sample, Rigid::fromXyzYawPitchRoll(0.2, 0, 0, 0, 0, 0), "imu"};
  writer.add(measured);
  writer.close();
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile((folder / "keyframes.simplemap").string()));
  const auto imu = map.begin()->sf->getObservationByClass<mrpt::obs::CObservationIMU>();
  ASSERT_TRUE(imu);
  const std::optional<RecordedImu> read = fromObservation(*imu);
  ASSERT_TRUE(read);
  EXPECT_LT((read->sample.gyro - sample.gyro).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(read->body_T_imu.translation.x(), 0.2);
  EXPECT_EQ(map.begin()->sf->size(), 3U);
}

TEST(SimpleMapWriter, writesTheSameBytesForTheSameKeyframes)
{
  const TemporaryFolder folder;
  for (const char* name : {"a", "b"})
  {
    SimpleMapWriter writer(folder / name, twoLidars());
    writer.add({onePointOfEach()});
    writer.close();
  }
  EXPECT_EQ(contentOf(folder / "a"), contentOf(folder / "b"));
}

TEST(SimpleMapWriter, holdsNoKeyframeThatItHasWritten)
{
  const TemporaryFolder folder;
  MeasuredKeyframe measured{onePointOfEach()};
  measured.keyframe.points.resize(50'000);  // more than 1 MB
  for (std::size_t i = 0; i < measured.keyframe.points.size(); ++i)
    measured.keyframe.points.x[i] = std::sin(static_cast<float>(i));
  SimpleMapWriter writer(folder / "keyframes.simplemap", twoLidars());
  constexpr std::uint32_t kKeyframes = 60;
  for (int i = 0; i < 10; ++i) writer.add(measured);
  const long before = peakMegabytes();
  for (std::uint32_t i = 10; i < kKeyframes; ++i) writer.add(measured);
  writer.close();
  EXPECT_LT(peakMegabytes() - before, 20);
  EXPECT_EQ(SimpleMapReader(folder / "keyframes.simplemap").size(), kKeyframes);
}

TEST(SimpleMapWriter, refusesAPointOfAnUnknownLidar)
{
  const TemporaryFolder folder;
  SimpleMapWriter writer(folder / "keyframes.simplemap", {twoLidars().front()});
  EXPECT_THROW(writer.add({onePointOfEach()}), std::invalid_argument);
}
}  // namespace
}  // namespace scanloom::simple_map_file_unittest
