#include <gmock/gmock.h>

#include "input/packets/CaptureReader.h"
#include "input/packets/CaptureWriter.h"
#include "input/rig/RecognisedRig.h"
#include "input/rig/Rig.h"
#include "liveRig.h"
#include "support/HandmadeMessages.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/messageOf.h"

namespace scanloom::bag_rig_unittest
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::uint64_t kStart = 1'700'000'000'000'000'000, kTurn = 100'000'000;
constexpr std::uint32_t kColumns = 100;

/** Two points a column. */
std::string turnAt(std::uint64_t start, const std::string& frame)
{
  std::vector<HandmadePoint> points;
  for (std::uint32_t i = 0; i < kColumns; ++i)
    for (const std::uint8_t ring : {0, 1}) points.push_back({10, 1, ring * 1.0F, i * 1'000'000, ring});
  return cloudMessage(start, frame, points);
}

/** Each cloud is published as its turn ends; the right lidar turns half a turn later. */
std::vector<HandmadeMessage> driveOfTwoLidars()
{
  std::vector<HandmadeMessage> messages{
      {"/tf_static", "tf2_msgs/TFMessage", kStart, transformMessage("base_link", "left_lidar", 1)},
      {"/tf_static", "tf2_msgs/TFMessage", kStart, transformMessage("base_link", "right_lidar", -1)},
      {"/tf_static", "tf2_msgs/TFMessage", kStart, transformMessage("base_link", "imu_link", 0.5)}};
  for (std::uint64_t turn = 0; turn < 20; ++turn)
    for (const auto& [side, after] : {std::pair{"left", std::uint64_t{0}}, std::pair{"right", kTurn / 2}})
    {
      const std::uint64_t start = kStart + turn * kTurn + after;
      const std::string name = side;
      messages.push_back(
          {"/" + name + "/points", "sensor_msgs/PointCloud2", start + kTurn, turnAt(start, name + "_lidar")});
      messages.push_back({"/imu/data", "sensor_msgs/Imu", start, imuMessage(start, "imu_link")});
    }
  return messages;
}

Rig rigOf(const RecognisedRig& recognised)
{
  return makeRig(readRigSettings(Configuration::fromText(recognised.ini, "recognised"), kRecognisedSection));
}

std::vector<Scan> scansOf(const Rig& rig)
{
  RigReplay replay(rig);
  return scansIn(eventsOf(replay));
}
}  // namespace

TEST(BagRig, hasTheTopicsAndThePosesOfItsStaticTransforms)
{
  const TemporaryFolder folder;
  writeFile(folder / "drive.bag", ros1Of(driveOfTwoLidars(), "lz4"));
  const RecognisedRig recognised = recogniseRig(filesOf({folder / "drive.bag"}));
  EXPECT_TRUE(recognised.poses_known);
  EXPECT_THAT(recognised.ini, HasSubstr("lidar1_topic     = /left/points"));
  const Rig rig = rigOf(recognised);
  ASSERT_EQ(rig.lidars.size(), 2u);
  EXPECT_EQ(rig.lidars[0].name, "left");
  EXPECT_DOUBLE_EQ(rig.lidars[1].decoder->description().body_T_sensor.translation.x(), -1);
  EXPECT_DOUBLE_EQ(rig.lidars[1].decoder->description().frame_rate, 10);
  EXPECT_DOUBLE_EQ(rig.body_T_imu->translation.x(), 0.5);
  EXPECT_EQ(rig.body_imu.size(), 40u);
}

TEST(BagRig, namesLidarsByTheFirstPartOfTheirTopicsThatDiffers)
{
  const TemporaryFolder folder;
  std::vector<HandmadeMessage> messages = driveOfTwoLidars();
  for (HandmadeMessage& message : messages)
    if (message.topic != "/tf_static") message.topic = "/sensing/lidar" + message.topic;
  writeFile(folder / "drive.bag", ros1Of(messages));
  const Rig rig = rigOf(recogniseRig(filesOf({folder / "drive.bag"})));
  EXPECT_EQ(rig.lidars.at(0).name, "left");
  EXPECT_EQ(rig.lidars.at(1).name, "right");
}

TEST(BagRig, weavesTheCloudsOfTwoDriversByTheStampsOfTheirPoints)
{
  const TemporaryFolder folder;
  writeFile(folder / "drive.bag", ros1Of(driveOfTwoLidars()));
  RigReplay replay(rigOf(recogniseRig(filesOf({folder.path()}))));
  int whole_scans = 0;
  for (const Scan& scan : scansIn(eventsOf(replay)))
  {
    if (scan.columns_of[0] + scan.columns_of[1] < 2 * kColumns) continue;
    ++whole_scans;
    EXPECT_EQ(scan.points.size(), 4 * kColumns);
    EXPECT_TRUE(std::is_sorted(scan.points.t.begin(), scan.points.t.end()));
  }
  EXPECT_GE(whole_scans, 17);  // of 20 turns: the first and last scans are of one lidar, or cut
  for (const LidarAccount& lidar : replay.account().lidars)
  {
    EXPECT_EQ(lidar.counters.late, 0u) << lidar.name;
    EXPECT_EQ(lidar.counters.lost, 0u) << lidar.name;
    EXPECT_EQ(lidar.counters.received, 20 * kColumns) << lidar.name;
  }
}

/** A recorder hangs and writes what waits at once; a network is slow; a relay sends everything twice. */
TEST(BagRig, ofCloudsThatCameLateAtOnceOrTwiceGivesTheSameScans)
{
  const auto scansOfClouds = [](std::vector<HandmadeMessage> messages)
  {
    std::stable_sort(messages.begin(), messages.end(),
                     [](const auto& a, const auto& b) { return a.received < b.received; });
    const TemporaryFolder folder;
    writeFile(folder / "drive.bag", ros1Of(messages));
    const RecognisedRig recognised = recogniseRig(filesOf({folder.path()}));
    EXPECT_THAT(recognised.ini, HasSubstr("scan_rate        = 10\n"));
    return scansOf(rigOf(recognised));
  };
  const std::vector<HandmadeMessage> punctual = driveOfTwoLidars();
  const std::vector<Scan> expected = scansOfClouds(punctual);

  std::vector<HandmadeMessage> late = punctual, hung = punctual, twice = punctual;
  for (std::size_t i = 3; i < late.size(); ++i) late[i].received += (i * 37 % 220) * 1'000'000;
  for (HandmadeMessage& message : hung)
    if (message.received > kStart + 5 * kTurn) message.received = std::max(message.received, kStart + 15 * kTurn);
  twice.insert(twice.end(), punctual.begin(), punctual.end());
  for (const auto& messages : {late, hung, twice})
  {
    const std::vector<Scan> scans = scansOfClouds(messages);
    ASSERT_EQ(scans.size(), expected.size());
    for (std::size_t i = 0; i < scans.size(); ++i)
    {
      EXPECT_EQ(scans[i].start, expected[i].start);
      EXPECT_EQ(scans[i].points.t, expected[i].points.t);
      EXPECT_EQ(scans[i].points.sensor_id, expected[i].points.sensor_id);
    }
  }
}

TEST(BagRig, whoseFirstCloudIsBrokenHasItsLidarAllTheSame)
{
  std::vector<HandmadeMessage> messages = driveOfTwoLidars();
  const auto first = std::find_if(messages.begin(), messages.end(),
                                  [](const HandmadeMessage& m) { return m.topic == "/left/points"; });
  first->data.resize(first->data.size() / 2);
  const TemporaryFolder folder;
  writeFile(folder / "drive.bag", ros1Of(messages));
  const Rig rig = rigOf(recogniseRig(filesOf({folder.path()})));
  EXPECT_EQ(rig.lidars.size(), 2u);
  RigReplay replay(rig);
  while (replay.next())
    ;
  EXPECT_EQ(replay.account().input.at("records_malformed"), 1u);
}

TEST(BagRig, ofRecordedPacketsIsRecognisedByThem)
{
  SCANLOOM_NEEDS_DATA(bag,
                      "other-lidars/tier4+nebula/src/nebula_velodyne/nebula_velodyne/test_resources/"
                      "decoder_ground_truth/vlp32/1713492677464078412");
  const RecognisedRig recognised = recogniseRig(filesOf({bag}));
  EXPECT_THAT(recognised.ini, HasSubstr("lidar1_topic     = /sensing/lidar/front/velodyne_packets"));
  RigReplay replay(rigOf(recognised));
  std::size_t points = 0;
  for (const Scan& scan : scansIn(eventsOf(replay))) points += scan.points.size();
  EXPECT_GT(points, 80'000u);  // the reference has 26216 points a turn
  EXPECT_EQ(replay.account().lidars.at(0).counters.packets, 379u);
}

TEST(BagRig, ofACapturesPacketsGivesTheSameScansAsTheCapture)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder folder;
  std::filesystem::copy(recording / "extrinsics.txt", folder / "extrinsics.txt");
  const char* const kTopics[] = {"/left/lidar_packets", "/left/imu_packets", "/right/lidar_packets",
                                 "/right/imu_packets"};
  std::vector<HandmadeMessage> messages;
  CaptureReader capture(recording / "recording.pcap");
  std::filesystem::create_directory(folder / "capture");
  CaptureWriter part(folder / "capture" / "part.pcap");
  Datagram datagram;
  for (int i = 0; i < 1500 && capture.next(datagram); ++i)
  {
    part.write(datagram);
    const std::string bytes(datagram.payload.begin(), datagram.payload.end());
    messages.push_back({kTopics[datagram.destination_port - 7502], "ouster_ros/PacketMsg",
                        static_cast<std::uint64_t>(nanoseconds(datagram.received)), withLength(bytes)});
  }
  part.close();
  for (const std::string side : {"left", "right"})
    messages.push_back({"/" + side + "/metadata", "std_msgs/String", messages.front().received,
                        withLength(contentOf(recording / (side + ".json")))});
  writeFile(folder / "drive.bag", ros1Of(messages));
  for (const char* file : {"left.json", "right.json", "extrinsics.txt"})
    std::filesystem::copy(recording / file, folder / "capture" / file);

  const std::vector<Scan> expected = scansOf(rigOf(recogniseRig(filesOf({folder / "capture"}))));
  const std::vector<Scan> found = scansOf(rigOf(recogniseRig(filesOf({folder / "drive.bag"}))));
  ASSERT_GE(expected.size(), 5u);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_EQ(found[i].start, expected[i].start);
    ASSERT_EQ(found[i].points.size(), expected[i].points.size());
    EXPECT_TRUE(std::equal(found[i].points.x.begin(), found[i].points.x.end(), expected[i].points.x.begin()));
    EXPECT_TRUE(std::equal(found[i].points.t.begin(), found[i].points.t.end(), expected[i].points.t.begin()));
  }
}

TEST(BagRig, aTopicIsNoKeyAndNoFormulaOfTheConfiguration)
{
  const TemporaryFolder folder;
  const auto recognised = [&](const std::string& prefix)
  {
    std::vector<HandmadeMessage> messages = driveOfTwoLidars();
    for (HandmadeMessage& message : messages)
      if (message.topic != "/tf_static") message.topic = prefix + message.topic;
    writeFile(folder / "drive.bag", ros1Of(messages));
    return recogniseRig(filesOf({folder / "drive.bag"}));
  };
  EXPECT_THROW(recognised("/$eval{1+1}"), std::invalid_argument);
  EXPECT_THROW(recognised("/$env{HOME}"), std::invalid_argument);
  EXPECT_THAT(recognised("/a\nimu_csv = /etc/passwd\n").ini, testing::Not(HasSubstr("\nimu_csv")));
  EXPECT_EQ(scansOf(rigOf(recognised("/" + std::string(5000, 'a')))).size(), scansOf(rigOf(recognised(""))).size());
}

TEST(BagRig, thatNamesAnUnknownTopicIsToldThoseThereAre)
{
  const TemporaryFolder folder;
  writeFile(folder / "drive.bag", ros1Of(driveOfTwoLidars()));
  const auto problemOf = [&](const std::string& keys)
  {
    return messageOf<ConfigError>(
        [&]
        {
          const std::string ini =
              "[lidars]\ndriver = CMultiLidarSensor\npcap_input = " + (folder / "drive.bag").string() +
              "\nlidar1_pose = [0 0 0 0 0 0]\nimu_pose = [0 0 0 0 0 0]\n" + keys;
          makeRig(readRigSettings(Configuration::fromText(ini, "ini"), "lidars"));
        });
  };
  const std::string metadata = "lidar1_metadata = topic:/left/points\n";
  EXPECT_THAT(problemOf(metadata + "lidar1_topic = /front\n"), HasSubstr("/left/points, /right/points"));
  EXPECT_THAT(problemOf(metadata), HasSubstr("lidar1_topic is missing"));
  EXPECT_THAT(problemOf("lidar1_metadata = topic:/m\nlidar1_topic = /left/points\n"), HasSubstr("topic:/m"));
  EXPECT_THAT(problemOf(metadata + "lidar1_topic = /left/points\nimu_topic = /imu\n"), HasSubstr("/imu/data"));
  EXPECT_EQ(problemOf(metadata + "lidar1_topic = /left/points\nimu_topic = /imu/data\n"), "");
}
}  // namespace scanloom::bag_rig_unittest
