#include "input/bags/BagContents.h"

#include <gmock/gmock.h>

#include "support/HandmadeMessages.h"
#include "support/TemporaryFolder.h"

namespace scanloom::bag_contents_unittest
{
namespace
{
using testing::HasSubstr;

std::string point(std::uint64_t stamp, double x)
{
  return headerOf(stamp, "map") + littleEndian(x) + littleEndian(0.0) + littleEndian(0.0);
}

std::string problemOf(const std::function<void()>& reading)
try
{
  reading();
  return "";
}
catch (const std::invalid_argument& problem)
{
  return problem.what();
}

TEST(BagContents, refuseACloudOfMorePointsThanATurnHas)
{
  const TemporaryFolder folder;
  const std::vector<HandmadePoint> many(2'000'001);
  writeFile(folder / "bag", ros1Of({{"/a", "sensor_msgs/PointCloud2", 1, cloudMessage(1, "lidar", many)}}));
  EXPECT_THAT(contentsOf({folder / "bag"}).topics.at(0).note, HasSubstr("a cloud of 2000001 points"));
}

/** sensor_msgs/PointCloud2 with a field 'timestamp' of doubles. */
std::string cloudWithTimes(std::uint64_t header, const std::vector<double>& times)
{
  std::string data;
  for (const double time : times)
    data += littleEndian(1.0F) + littleEndian(2.0F) + littleEndian(3.0F) + littleEndian(time);
  const auto count = static_cast<std::uint32_t>(times.size());
  constexpr std::uint32_t kStep = 20;
  return headerOf(header, "lidar") + littleEndian(std::uint32_t{1}) + littleEndian(count) +
         littleEndian(std::uint32_t{4}) + cloudField("x", 0, 7) + cloudField("y", 4, 7) + cloudField("z", 8, 7) +
         cloudField("timestamp", 12, 8) + std::string(1, '\0') + littleEndian(kStep) + littleEndian(kStep * count) +
         withLength(data) + std::string(1, '\1');
}

TopicContents contentsOfCloud(std::uint64_t header, const std::vector<double>& times)
{
  const TemporaryFolder folder;
  writeFile(folder / "bag", ros1Of({{"/a", "sensor_msgs/PointCloud2", header, cloudWithTimes(header, times)}}));
  return contentsOf({folder / "bag"}).topics.at(0);
}

TEST(BagContents, takeTheUnitOfTimesInWhichTheyAreTheHeaders)
{
  const std::uint64_t booted = 221'300'000'000, utc = 1'700'000'000'000'000'000;
  EXPECT_THAT(contentsOfCloud(booted, {221.298, 221.398}).note, HasSubstr("float64, s"));
  EXPECT_THAT(contentsOfCloud(booted, {221.298e9, 221.398e9}).note, HasSubstr("float64, ns"));
  EXPECT_THAT(contentsOfCloud(utc, {1.7e15, 1.7e15 + 1e5}).note, HasSubstr("float64, us"));
  EXPECT_THAT(contentsOfCloud(utc, {1.7e9, 1.7e9 + 0.1}).note, HasSubstr("float64, s"));
  EXPECT_THAT(contentsOfCloud(utc, {0, 0.1}).note, HasSubstr("s after the header's stamp"));
  EXPECT_THAT(contentsOfCloud(utc, {4e3, 4e3 + 0.1}).note, HasSubstr("neither a turn after the header's stamp"));
}

TEST(BagContents, sayWhereAllPointsOfACloudHaveOneTime)
{
  EXPECT_TRUE(contentsOfCloud(1'000'000'000, {0.05, 0.05}).one_instant);
  EXPECT_FALSE(contentsOfCloud(1'000'000'000, {0.05, 0.06}).one_instant);
}

TEST(BagContents, sayWhatTheTimeOfCloudsIs)
{
  const TemporaryFolder folder;
  const auto timedAt = [](std::uint64_t stamp) {
    return cloudMessage(stamp, "lidar", {{1, 2, 3, 0, 0}, {1, 2, 3, 90'000'000, 5}});
  };
  const std::string timed = timedAt(1'000'000'000);
  std::string untimed = timed;
  untimed[untimed.find("t\x0c")] = 'q';
  writeFile(folder / "bag", ros1Of({{"/a", "sensor_msgs/PointCloud2", 1'000'000'000, timed},
                                    {"/a", "sensor_msgs/PointCloud2", 1'200'000'000, timed},  // twice, and late
                                    {"/a", "sensor_msgs/PointCloud2", 1'210'000'000, timedAt(1'050'000'000)},
                                    {"/b", "sensor_msgs/PointCloud2", 1'000'000'000, untimed}}));
  const BagContents contents = contentsOf({folder / "bag"});
  ASSERT_EQ(contents.topics.size(), 2u);
  EXPECT_EQ(contents.topics[0].note, "field 't': uint32, ns after the header's stamp");
  EXPECT_THAT(contents.topics[1].note, HasSubstr("its fields are: x, y, z, q, ring"));
  EXPECT_EQ(contents.metadata.at("/a"), R"({"lidar": "cloud", "rate": 20, "channels": 6})");
  EXPECT_EQ(metadataIn({folder / "bag"}, "/a"), contents.metadata.at("/a"));
  EXPECT_THAT(problemOf([&] { metadataIn({folder / "bag"}, "/c"); }), HasSubstr("some are on: /a"));
}

TEST(BagContents, countMessagesThatEndTooEarly)
{
  const TemporaryFolder folder;
  const char* type = "geometry_msgs/PointStamped";
  writeFile(folder / "bag", ros1Of({{"/prism", type, 1, point(5, 2)},
                                    {"/prism", type, 2, point(6, 1).substr(0, 20)},
                                    {"/imu", "sensor_msgs/Imu", 3, point(7, 1)}}));
  EXPECT_EQ(readBagPoses({folder / "bag"}, "/prism").poses.size(), 1u);
  EXPECT_EQ(readBagPoses({folder / "bag"}, "/prism").unreadable, 1u);
  const ImuOfEachStamp imu = readBagImu({folder / "bag"}, "/imu");
  EXPECT_TRUE(imu.samples.empty());
  EXPECT_THAT(imu.leftOut().value_or(""), HasSubstr("1 messages cannot be read"));
}

TEST(BagContents, passOverMessagesInAnotherForm)
{
  const TemporaryFolder folder;
  const char* type = "geometry_msgs/msg/PointStamped";
  const std::string content = std::string(8, '\1') + std::string("\1\0\0\0\0\0\0\0", 8) + std::string(24, '\0');
  const HandmadeMessage plain{"/prism", type, 1, std::string("\0\1\0\0", 4) + content},
      other{"/prism", type, 2, std::string("\0\7\0\0", 4) + content};
  writeFile(folder / "a.mcap", mcapOf({other, plain}));
  EXPECT_EQ(readBagPoses({folder / "a.mcap"}, "/prism").poses.size(), 1u);
  EXPECT_EQ(readBagPoses({folder / "a.mcap"}, "/prism").unreadable, 1u);
  writeFile(folder / "b.mcap", mcapOf({other}));
  EXPECT_THAT(problemOf([&] { readBagPoses({folder / "b.mcap"}, "/prism"); }), HasSubstr("another form of CDR"));
}

TEST(BagContents, givePosesInTheOrderOfStampsEachOnce)
{
  const TemporaryFolder folder;
  const char* type = "geometry_msgs/PointStamped";
  writeFile(
      folder / "bag",
      ros1Of({{"/prism", type, 1, point(5, 2)}, {"/prism", type, 2, point(4, 1)}, {"/prism", type, 3, point(5, 9)}}));
  const BagPoses found = readBagPoses({folder / "bag"}, "");
  EXPECT_FALSE(found.have_rotations);
  ASSERT_EQ(found.poses.size(), 2u);
  EXPECT_EQ(found.poses[0].map_T_body.translation.x(), 1);
  EXPECT_EQ(found.poses[1].map_T_body.translation.x(), 2);
  EXPECT_THAT(problemOf([&] { readBagPoses({folder / "bag"}, "/odom"); }), HasSubstr("topics with poses: /prism"));
  EXPECT_THAT(problemOf([&] { readBagImu({folder / "bag"}, "/imu"); }), HasSubstr("topics with sensor_msgs/Imu: none"));
}
}  // namespace
}  // namespace scanloom::bag_contents_unittest
