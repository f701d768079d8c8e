#include "mrpt/edit/internal/ToMcap.h"

#include <gmock/gmock.h>

#include "input/bags/BagContents.h"
#include "input/bags/internal/CloudMessage.h"
#include "mrpt/observations/Observations.h"
#include "support/TemporaryFolder.h"

namespace scanloom::to_mcap_unittest
{
namespace
{
Scan scanAt(Timestamp start)
{
  Scan scan;
  scan.start = start;
  scan.period = 100ms;
  scan.columns_of = {1, 1};
  scan.points.resize(2);
  for (std::uint8_t i = 0; i < 2; ++i)
  {
    scan.points.x[i] = 1.5F + i;
    scan.points.y[i] = -2;
    scan.points.z[i] = 0.25F;
    scan.points.t[i] = 50'000'000 * i;
    scan.points.ring[i] = static_cast<std::uint8_t>(7 + i);
    scan.points.sensor_id[i] = i;
    scan.points.intensity[i] = 100;
  }
  scan.columns = {{start, 0, 1, 3, 0, 0}, {start + 50ms, 1, 1, 4, 0, 1}};
  return scan;
}

constexpr Timestamp kStart{1'700'000'000s};

StampedPose poseAhead(Timestamp stamp, double x)
{
  Rigid pose;
  pose.translation.x() = x;
  return {stamp, pose};
}

TEST(ToMcap, writesCloudsImuAndPosesThatABagReaderReads)
{
  const TemporaryFolder folder;
  const auto file = folder / "drive.mcap";
  const RawlogOperation write = toMcap(file, {poseAhead(kStart, 0), poseAhead(kStart + 100ms, 2)}, std::nullopt);
  Rigid body_T_imu;
  body_T_imu.translation.z() = 1;
  write(toObservation(ImuSample{kStart, {0.1, 0.2, 0.3}, {0, 0, 9.81}}, body_T_imu, "imu left"));
  write(toObservation(scanAt(kStart)));
  write(toObservation(scanAt(kStart + 100ms)));
  write(nullptr);

  const BagContents contents = contentsOf({file});
  EXPECT_TRUE(contents.warnings.empty());
  std::vector<std::string> topics;
  for (const TopicContents& topic : contents.topics)
    topics.push_back(topic.name + " " + topic.type + " " + std::to_string(topic.messages));
  EXPECT_THAT(topics, testing::UnorderedElementsAre("/imu_left sensor_msgs/Imu 1", "/lidar sensor_msgs/PointCloud2 2",
                                                    "/path nav_msgs/Path 1", "/tf tf2_msgs/TFMessage 2",
                                                    "/tf_static tf2_msgs/TFMessage 1"));
  EXPECT_DOUBLE_EQ(contents.frames.transform("base_link", "imu_left")->translation.z(), 1);
  const std::vector<ImuSample> imu = readBagImu({file}, "/imu_left").samples;
  ASSERT_EQ(imu.size(), 1u);
  EXPECT_EQ(imu[0].gyro, Eigen::Vector3d(0.1, 0.2, 0.3));
}

TEST(ToMcap, writesCloudsOfOneLidarInItsFrame)
{
  const TemporaryFolder folder;
  RecordingHeader header;
  header.lidars.resize(2);
  header.lidars[0].name = "left";
  header.lidars[0].body_T_sensor.translation.x() = 0.5;
  header.lidars[1].name = "right";
  const auto file = folder / "drive.mcap";
  const RawlogOperation write = toMcap(file, {}, header);
  write(toObservation(scanAt(kStart), CloudClass::CGenericPointsMap, "lidar_left"));
  write(nullptr);
  const auto bag = BagReader::open(file);
  BagMessage message;
  while (bag->next(message) && bag->topics()[message.topic].name != "/lidar_left") continue;
  const TimedCloud cloud = timedCloudOf(bag->topics()[message.topic], message.data);
  EXPECT_EQ(cloud.frame, "left");
  EXPECT_EQ(cloud.points.at(0).x, 1);
  EXPECT_DOUBLE_EQ(contentsOf({file}).frames.transform("base_link", "left")->translation.x(), 0.5);
}

TEST(ToMcap, writesPointsWithTheirTimesAndRings)
{
  const TemporaryFolder folder;
  const auto file = folder / "drive.mcap";
  const RawlogOperation write = toMcap(file, {}, std::nullopt);
  write(toObservation(scanAt(kStart)));
  write(nullptr);
  const auto bag = BagReader::open(file);
  BagMessage message;
  ASSERT_TRUE(bag->next(message));
  const TimedCloud cloud = timedCloudOf(bag->topics()[message.topic], message.data);
  ASSERT_EQ(cloud.points.size(), 2u);
  EXPECT_EQ(cloud.time_is, "field 't': uint32, ns after the header's stamp");
  EXPECT_FLOAT_EQ(cloud.points[1].x, 2.5F);
  EXPECT_EQ(cloud.points[1].ring, 8);
  EXPECT_EQ(cloud.points[1].intensity, 100);
  EXPECT_LE(std::chrono::abs(cloud.points[1].stamp - (kStart + 50ms)), 104ns);  // a rawlog's t is a float
  EXPECT_FALSE(bag->next(message));
}
}  // namespace
}  // namespace scanloom::to_mcap_unittest
