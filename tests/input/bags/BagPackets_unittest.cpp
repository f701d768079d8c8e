#include "input/bags/BagPackets.h"

#include <gmock/gmock.h>

#include "input/bags/internal/PacketMessages.h"
#include "support/HandmadeBag.h"
#include "support/Rosbag.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"

namespace scanloom::bag_packets_unittest
{
namespace
{
constexpr const char* kNebula = "other-lidars/tier4+nebula/src/";

std::vector<Datagram> datagramsIn(const std::filesystem::path& bag)
{
  std::vector<Datagram> all;
  const auto readers = datagramsOf({bag});
  for (Datagram datagram; readers.front()->next(datagram);) all.push_back(datagram);
  EXPECT_EQ(readers.front()->counters().malformed, 0u);
  EXPECT_TRUE(readers.front()->counters().damages.empty());
  return all;
}

struct RecordedBag
{
  const char* folder;
  std::size_t packets;  // as the packages' authors count them
  std::size_t bytes;    // of each
};

class RecordedBags : public testing::TestWithParam<RecordedBag>
{
};

TEST_P(RecordedBags, giveEveryPacketInTheOrderOfStamps)
{
  SCANLOOM_NEEDS_DATA(bag, std::string("other-lidars/tier4+nebula/") + GetParam().folder);
  const std::vector<Datagram> datagrams = datagramsIn(bag);
  EXPECT_EQ(datagrams.size(), GetParam().packets);
  for (std::size_t i = 0; i < datagrams.size(); ++i)
  {
    EXPECT_EQ(datagrams[i].payload.size(), GetParam().bytes);
    EXPECT_EQ(datagrams[i].topic, datagrams[0].topic);
    EXPECT_EQ(datagrams[i].destination_port, 0);
  }
  EXPECT_TRUE(std::is_sorted(datagrams.begin(), datagrams.end(),
                             [](const Datagram& a, const Datagram& b) { return a.received < b.received; }));
}

INSTANTIATE_TEST_SUITE_P(
    Nebula, RecordedBags,
    testing::Values(
        RecordedBag{"src/nebula_velodyne/nebula_velodyne/test_resources/decoder_ground_truth/vlp16/1673400471837873222",
                    603, 1206},
        RecordedBag{"src/nebula_velodyne/nebula_velodyne/test_resources/decoder_ground_truth/vlp32/1713492677464078412",
                    379, 1206},
        RecordedBag{
            "src/nebula_velodyne/nebula_velodyne/test_resources/decoder_ground_truth/vls128/1614315746471294674", 2193,
            1206},
        RecordedBag{"src/nebula_hesai/nebula_hesai/test_resources/decoder_ground_truth/64/1673403880599376836", 2400,
                    1198},
        RecordedBag{"src/nebula_hesai/nebula_hesai/test_resources/decoder_ground_truth/xt32/1673400677802009732", 2000,
                    1080},
        RecordedBag{"nebula_tests/data/robosense/helios16P/rosbag2_2023_08_03-11_02_46", 751, 1248}));

TEST(BagPackets, areTheBytesAndStampsOfTheMessages)
{
  SCANLOOM_NEEDS_DATA(bag, std::string(kNebula) +
                               "nebula_hesai/nebula_hesai/test_resources/decoder_ground_truth/xt32/"
                               "1673400677802009732/1673400677802009732_0.db3");
  const std::vector<StampedPacket> expected = pandarPacketsOfBag(bag);
  const std::vector<Datagram> datagrams = datagramsIn(bag);
  ASSERT_EQ(datagrams.size(), expected.size());
  for (std::size_t i = 0; i < datagrams.size(); ++i)
  {
    EXPECT_EQ(datagrams[i].received, expected[i].received);
    EXPECT_EQ(datagrams[i].payload, expected[i].bytes);
  }
}

TEST(BagPackets, ofVelodynesAreTheBytesThatTheReferenceCloudsAreCheckedWith)
{
  for (const char* name : {"vlp16/1673400471837873222", "vlp32/1713492677464078412", "vls128/1614315746471294674"})
  {
    SCANLOOM_NEEDS_DATA(
        folder, std::string(kNebula) + "nebula_velodyne/nebula_velodyne/test_resources/decoder_ground_truth/" + name);
    const auto expected = packetsOfBag(folder / (folder.filename().string() + "_0.db3"), 1206);
    const std::vector<Datagram> datagrams = datagramsIn(folder);
    ASSERT_EQ(datagrams.size(), expected.size());
    for (std::size_t i = 0; i < datagrams.size(); ++i) EXPECT_EQ(datagrams[i].payload, expected[i]);
  }
}

TEST(BagPackets, ofSeveralTopicsComeWithTheseInTheOrderOfTime)
{
  const TemporaryFolder folder;
  const auto packet = [](const std::string& bytes) { return withLength(bytes); };  // uint8[] in ROS 1
  const char* type = "ouster_ros/PacketMsg";
  writeFile(folder / "drive.bag", ros1Of({{"/right", type, 3, packet("b")},
                                          {"/left", type, 2, packet("a")},
                                          {"/other", "std_msgs/String", 1, packet("c")}}));
  const auto readers = datagramsOf({folder / "drive.bag"});
  std::string seen;
  for (Datagram datagram; readers.front()->next(datagram);)
    seen += std::string(datagram.payload.begin(), datagram.payload.end()) + datagram.topic;
  EXPECT_EQ(seen, "a/leftb/right");
  EXPECT_EQ(readers.front()->counters().not_udp, 1u);
}

TEST(BagPackets, thatAMessageCutsOffAreCounted)
{
  const TemporaryFolder folder;
  writeFile(folder / "drive.bag", ros1Of({{"/left", "ouster_ros/PacketMsg", 2, std::string("\xff\0\0\0a", 5)}}));
  const auto readers = datagramsOf({folder / "drive.bag"});
  Datagram datagram;
  EXPECT_FALSE(readers.front()->next(datagram));
  EXPECT_EQ(readers.front()->counters().malformed, 1u);
}

TEST(BagPackets, ofATypeWithoutPacketsAreNone)
{
  EXPECT_TRUE(isPacketType("velodyne_msgs/VelodyneScan"));
  EXPECT_FALSE(isPacketType("sensor_msgs/Imu"));
}
}  // namespace
}  // namespace scanloom::bag_packets_unittest
