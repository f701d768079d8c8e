#include "mrpt/observations/Observations.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/observations/CGenericPointsMap.h"
#include "someScan.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/system/datetime.h>

namespace scanloom::observations_unittest
{
TEST(Conversions, agreesWithMrptOnWhatTimeItIs)
{
  // MRPT's own parser of dates is the reference.
  const mrpt::system::TTimeParts parts = {2024, 3, 21, 13, 0, 7.5, 0, 0};
  const Timestamp stamp = fromNanoseconds(1711026007'500'000'000);
  EXPECT_EQ(toMrpt(stamp), mrpt::system::buildTimestampFromParts(parts));
  EXPECT_EQ(fromMrpt(toMrpt(stamp)), stamp);
}

TEST(Conversions, roundsStampsDownToATick)
{
  EXPECT_EQ(fromMrpt(toMrpt(fromNanoseconds(1'000'000'199))), fromNanoseconds(1'000'000'100));
  EXPECT_EQ(fromMrpt(toMrpt(fromNanoseconds(-1))), fromNanoseconds(-100));
}

TEST(Conversions, agreesWithMrptOnAnglesOfAPose)
{
  const Rigid pose = Rigid::fromXyzYawPitchRoll(1, 2, 3, 0.4, -0.5, 0.6);
  const mrpt::poses::CPose3D mrpt_pose(1, 2, 3, 0.4, -0.5, 0.6);
  EXPECT_LT((toMrpt(pose).asTPose() - mrpt_pose.asTPose()).norm(), 1e-12);
  EXPECT_LT(boxMinus(fromMrpt(mrpt_pose), pose).norm(), 1e-12);
}

TEST(Observations, comeBackAsTheScanTheyWere)
{
  const Scan scan = someScan(fromNanoseconds(1'700'000'000'100'000'000));
  const auto observation = toObservation(scan);
  const Scan back = fromObservation(*observation, someHeader());

  EXPECT_EQ(back.start, scan.start);
  EXPECT_EQ(back.period, scan.period);
  EXPECT_EQ(back.columns_of, scan.columns_of);
  EXPECT_EQ(back.points.x, scan.points.x);
  EXPECT_EQ(back.points.y, scan.points.y);
  EXPECT_EQ(back.points.z, scan.points.z);
  EXPECT_EQ(back.points.intensity, scan.points.intensity);
  EXPECT_EQ(back.points.ring, scan.points.ring);
  EXPECT_EQ(back.points.column, scan.points.column);
  EXPECT_EQ(back.points.sensor_id, scan.points.sensor_id);
  ASSERT_EQ(back.columns.size(), scan.columns.size());
  for (std::size_t i = 0; i < scan.columns.size(); i++)
  {
    EXPECT_LE(std::abs((back.columns[i].stamp - scan.columns[i].stamp).count()), 4);
    EXPECT_EQ(back.columns[i].first_point, scan.columns[i].first_point);
    EXPECT_EQ(back.columns[i].count, scan.columns[i].count);
    EXPECT_EQ(back.columns[i].measurement_id, scan.columns[i].measurement_id);
    EXPECT_EQ(back.columns[i].sensor_id, scan.columns[i].sensor_id);
  }
}

TEST(Observations, standInTheBodyFrameAtTheStartOfTheScan)
{
  const Scan scan = someScan(fromNanoseconds(1'700'000'000'100'000'000));
  const auto observation = toObservation(scan);

  EXPECT_EQ(observation->sensorLabel, "lidar");
  EXPECT_EQ(observation->timestamp, toMrpt(scan.start));
  EXPECT_EQ(observation->sensorPose, mrpt::poses::CPose3D::Identity());
  const auto* map = dynamic_cast<const mrpt::maps::CGenericPointsMap*>(observation->pointcloud.get());
  ASSERT_TRUE(map);
  EXPECT_FLOAT_EQ(map->float_fields().at("t")[scan.points.size() - 1], 1e-9f * scan.points.t.back());
}

TEST(Observations, countPointTimesFromTheRoundedStamp)
{
  Scan scan = someScan(fromNanoseconds(1'066'666'667));  // a period of 15 Hz: not a whole number of ticks
  const auto observation = toObservation(scan);
  const auto* map = dynamic_cast<const mrpt::maps::CGenericPointsMap*>(observation->pointcloud.get());
  ASSERT_TRUE(map);

  ASSERT_EQ(scan.points.t.front(), 0);
  EXPECT_NEAR(map->float_fields().at("t")[0], 67e-9, 1e-12);
}

TEST(Observations, keepAnEmptyScan)
{
  Scan scan;
  scan.start = fromNanoseconds(5'000'000'000);
  scan.period = 100ms;
  const Scan back = fromObservation(*toObservation(scan), someHeader());
  EXPECT_TRUE(back.points.empty());
  EXPECT_EQ(back.start, scan.start);
  EXPECT_EQ(back.columns_of, (std::vector<std::uint32_t>{0, 0}));
}

TEST(Observations, tellTwoTurnsOfTheSameColumnApart)
{
  Scan scan;
  scan.points.resize(2);
  scan.points.t = {0, 50'000'000};
  EXPECT_EQ(fromObservation(*toObservation(scan), std::nullopt).columns.size(), 2u);
}

TEST(Observations, giveXyziItsIntensitiesInZeroToOne)
{
  const Scan scan = someScan(fromNanoseconds(0));
  const auto observation = toObservation(scan, CloudClass::CPointsMapXYZI);

  std::vector<float> fields;
  observation->pointcloud->getPointAllFieldsFast(3, fields);
  EXPECT_STREQ(observation->pointcloud->GetRuntimeClass()->className, "mrpt::maps::CPointsMapXYZI");
  EXPECT_FLOAT_EQ(fields.at(3), scan.points.intensity[3] / 255.f);
  EXPECT_FLOAT_EQ(fromObservation(*observation, std::nullopt).points.intensity[3], scan.points.intensity[3]);
}

TEST(Observations, bringForeignCloudsIntoTheBodyFrame)
{
  auto map = mrpt::maps::CSimplePointsMap::Create();
  map->insertPoint(1, 0, 0);
  mrpt::obs::CObservationPointCloud observation;
  observation.pointcloud = map;
  observation.sensorPose = mrpt::poses::CPose3D(10, 0, 0, mrpt::DEG2RAD(90.0), 0, 0);

  const Scan scan = fromObservation(observation, std::nullopt);

  ASSERT_EQ(scan.points.size(), 1u);
  EXPECT_TRUE(scan.points.position(0).isApprox(Eigen::Vector3f(10, 1, 0)));
}

TEST(Observations, splitARunThatIsLongerThanAColumnCanCount)
{
  auto map = mrpt::maps::CSimplePointsMap::Create();
  map->resize(70'000);
  mrpt::obs::CObservationPointCloud observation;
  observation.pointcloud = map;

  const Scan scan = fromObservation(observation, std::nullopt);

  ASSERT_EQ(scan.columns.size(), 2u);
  EXPECT_EQ(scan.columns[0].count + scan.columns[1].count, 70'000);
}

TEST(Observations, keepAnImuSampleAndWhereItsSensorSits)
{
  const ImuSample sample{fromNanoseconds(1'700'000'000'123'456'700), {0.1, -0.2, 0.3}, {1, 2, 9.81}};
  const Rigid body_T_imu = Rigid::fromXyzYawPitchRoll(0.15, -0.3, 2.85, 1.5, 0.02, -0.01);

  const auto back = fromObservation(*toObservation(sample, body_T_imu));

  ASSERT_TRUE(back);
  EXPECT_EQ(back->sample.stamp, sample.stamp);
  EXPECT_EQ(back->sample.gyro, sample.gyro);
  EXPECT_EQ(back->sample.accel, sample.accel);
  EXPECT_LT(boxMinus(back->body_T_imu, body_T_imu).norm(), 1e-12);
  EXPECT_EQ(back->label, "imu");
}

TEST(Observations, nameTurnRatesByAxisAsMrptDoes)
{
  const auto observation = toObservation(ImuSample{{}, {1, 2, 3}, {4, 5, 6}}, Rigid::identity());
  EXPECT_EQ(observation->get(mrpt::obs::IMU_ROLL_VEL), 1);   // about x
  EXPECT_EQ(observation->get(mrpt::obs::IMU_PITCH_VEL), 2);  // about y
  EXPECT_EQ(observation->get(mrpt::obs::IMU_YAW_VEL), 3);    // about z
}

TEST(Observations, giveNoSampleOfAnImuWithoutGyroscope)
{
  mrpt::obs::CObservationIMU observation;
  observation.set(mrpt::obs::IMU_X_ACC, 1);
  EXPECT_FALSE(fromObservation(observation));
}

TEST(CloudClass, isNamedAsMrptNamesIt)
{
  EXPECT_EQ(cloudClassFromName("CPointsMapXYZI"), CloudClass::CPointsMapXYZI);
  EXPECT_THROW(cloudClassFromName("CPointsMapXYZIRT"), std::invalid_argument);
}
}  // namespace scanloom::observations_unittest
