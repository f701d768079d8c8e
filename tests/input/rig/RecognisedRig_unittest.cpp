#include "input/rig/RecognisedRig.h"

#include "base/core/ConfigError.h"
#include "input/packets/CaptureWriter.h"
#include "input/rig/Rig.h"
#include "input/rig/internal/RigReplay.h"
#include "support/Rosbag.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/mergedCaptures.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>

#include <functional>

namespace scanloom::recognised_rig_unittest
{
namespace
{
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using Path = std::filesystem::path;

/** Those of the first datagrams that `wanted` keeps and may change. */
void writeSome(const Path& from, const Path& to, const std::function<bool(Datagram&)>& wanted)
{
  MergedCaptures datagrams = mergedCaptures({from});
  CaptureWriter writer(to);
  Datagram datagram;
  for (int i = 0; i < 2000 && datagrams.next(datagram); ++i)
    if (wanted(datagram)) writer.write(datagram);
  writer.close();
}

bool isOfLeft(const Datagram& datagram) { return datagram.destination_port <= 7503; }

Rig rigFrom(const RecognisedRig& recognised)
{
  return makeRig(readRigSettings(Configuration::fromText(recognised.ini, "recognised"), kRecognisedSection));
}

std::string refusalOf(const std::vector<Path>& recording)
{
  return messageOf<UsageError>([&] { recogniseRig(filesOf(recording)); });
}
}  // namespace

TEST(RecognisedRig, ofAFolderHasItsLidarsPortsPosesAndImu)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const RecognisedRig recognised = recogniseRig(filesOf({folder}));
  const Rig rig = rigFrom(recognised);
  ASSERT_EQ(rig.lidars.size(), 2U);
  EXPECT_EQ(rig.lidars[0].name, "left");
  EXPECT_EQ(rig.lidars[1].name, "right");
  EXPECT_EQ(rig.addresses[0].lidar_port, 7502);
  EXPECT_EQ(rig.addresses[1].imu_port, 7505);
  EXPECT_NEAR(rig.sensors[0].body_T_sensor.translation.x(), 1.5, 1e-9);  // its extrinsics.txt
  EXPECT_FALSE(rig.body_imu.empty());
  EXPECT_TRUE(recognised.poses_known);
  EXPECT_THAT(recognised.notes, ElementsAre());
}

TEST(RecognisedRig, hasThePortsThatTheCaptureShows)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const TemporaryFolder moved;
  writeSome(folder / "recording.pcap", moved / "drive.pcap",
            [](Datagram& datagram)
            {
              datagram.destination_port = static_cast<std::uint16_t>(datagram.destination_port + 50000);
              return datagram.destination_port <= 57503;
            });
  std::filesystem::copy(folder / "left.json", moved / "any_name.json");
  const Rig rig = rigFrom(recogniseRig(filesOf({moved / "drive.pcap"})));
  ASSERT_EQ(rig.lidars.size(), 1U);
  EXPECT_EQ(rig.lidars[0].name, "any_name");
  EXPECT_EQ(rig.addresses[0].lidar_port, 57502);
  EXPECT_EQ(rig.addresses[0].imu_port, 57503);
}

TEST(RecognisedRig, givesEachLidarItsImuWherePortsAreNotThoseOfTheMetadata)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const TemporaryFolder moved;
  writeSome(folder / "recording.pcap", moved / "drive.pcap",
            [](Datagram& datagram)
            {
              datagram.destination_port = static_cast<std::uint16_t>(datagram.destination_port + 50000);
              return true;
            });
  for (const char* metadata : {"left.json", "right.json"}) std::filesystem::copy(folder / metadata, moved / metadata);
  std::filesystem::copy(folder / "extrinsics.txt", moved / "extrinsics.txt");
  const RecognisedRig recognised = recogniseRig(filesOf({moved.path()}));
  EXPECT_EQ(rigFrom(recognised).addresses[0].imu_port, 57503);
  EXPECT_EQ(rigFrom(recognised).addresses[1].imu_port, 57505);
  EXPECT_THAT(recognised.notes, ElementsAre());
}

TEST(RecognisedRig, marksThePosesThatItCannotKnow)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const TemporaryFolder bare;
  writeSome(folder / "recording.pcap", bare / "drive.pcap", [](Datagram&) { return true; });
  for (const char* metadata : {"left.json", "right.json"}) std::filesystem::copy(folder / metadata, bare / metadata);
  const RecognisedRig recognised = recogniseRig(filesOf({bare.path()}));
  EXPECT_THAT(recognised.unknown_poses, ElementsAre("lidar1_pose", "lidar2_pose"));
  EXPECT_THAT(recognised.ini, AllOf(HasSubstr("FILL IN"), HasSubstr("//lidar2_pose")));
  EXPECT_THAT(recognised.notes, Contains(HasSubstr("scanloom calibrate")));
  EXPECT_THROW(rigFrom(recognised), ConfigError);
}

TEST(RecognisedRig, isRefusedWhereTwoMetadataFitAlike)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const TemporaryFolder twice;
  writeSome(folder / "recording.pcap", twice / "drive.pcap", &isOfLeft);
  std::filesystem::copy(folder / "left.json", twice / "one.json");
  std::filesystem::copy(folder / "left.json", twice / "other.json");
  EXPECT_THAT(refusalOf({twice / "drive.pcap"}), AllOf(HasSubstr("one.json"), HasSubstr("other.json")));

  std::filesystem::copy(folder / "left.json", twice / "drive.json");  // named like the capture
  EXPECT_EQ(rigFrom(recogniseRig(filesOf({twice / "drive.pcap"}))).lidars.front().name, "drive");
}

TEST(RecognisedRig, ofAnotherSensorsMetadataNamesBothSerialNumbers)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const TemporaryFolder wrong;
  writeSome(folder / "recording.pcap", wrong / "drive.pcap", &isOfLeft);
  std::filesystem::copy(folder / "right.json", wrong / "right.json");
  EXPECT_THAT(refusalOf({wrong / "drive.pcap"}), AllOf(HasSubstr("122322000615"), HasSubstr("122150000151")));
}

TEST(RecognisedRig, metadataOfAnotherProfileAreNamedWithThePortWhosePacketsTheyDoNotDescribe)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const TemporaryFolder changed;
  writeSome(folder / "recording.pcap", changed / "drive.pcap", [](const Datagram&) { return true; });
  std::filesystem::copy(folder / "right.json", changed / "right.json");
  const std::string left = contentOf(folder / "left.json"), profile = "RNG15_RFL8_NIR8";
  std::ofstream(changed / "left.json") << std::string(left).replace(left.find(profile), profile.size(), "LEGACY");
  EXPECT_THAT(recogniseRig(filesOf({changed.path()})).notes,
              Contains(AllOf(HasSubstr("to port 7502"), HasSubstr("left.json describes packets to this port"),
                             HasSubstr("fetch the sensor's metadata again"))));
}

TEST(RecognisedRig, keepsALidarThatSentNothingIfItsPoseIsGiven)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const TemporaryFolder silent;
  writeSome(folder / "recording.pcap", silent / "drive.pcap", &isOfLeft);
  for (const char* file : {"left.json", "right.json"}) std::filesystem::copy(folder / file, silent / file);
  EXPECT_EQ(rigFrom(recogniseRig(filesOf({silent.path()}))).lidars.size(), 1U) << "another recording's, perhaps";
  EXPECT_THAT(recogniseRig(filesOf({silent.path()})).notes, Contains(HasSubstr("no packet is of")));

  std::filesystem::copy(folder / "extrinsics.txt", silent / "extrinsics.txt");
  const RecognisedRig recognised = recogniseRig(filesOf({silent.path()}));
  EXPECT_EQ(rigFrom(recognised).lidars.size(), 2U);
  EXPECT_THAT(recognised.notes, Contains(AllOf(HasSubstr("no packet is of"), HasSubstr("right.json"))));
}

TEST(RecognisedRig, knowsAVelodyneByItsPackets)
{
  SCANLOOM_NEEDS_DATA(hdl32e, "other-lidars/Kitware+VeloView/Testing/Data/monterey-first-100-packets.pcap");
  EXPECT_THAT(recogniseRig(filesOf({hdl32e})).ini, HasSubstr("lidar1_metadata  = HDL-32E"));
  EXPECT_THAT(recogniseRig(filesOf({hdl32e})).notes, ElementsAre()) << "its positions come to another port";
  // It bears the HDL-32E's number, but is at a VLP-16's pace (INVENTORY).
  SCANLOOM_NEEDS_DATA(vlp16, "other-lidars/jerry73204+rust-lidar-utils/velodyne-test/test_files/velodyne_vlp16.pcap");
  EXPECT_THAT(recogniseRig(filesOf({vlp16})).ini, HasSubstr("lidar1_metadata  = VLP-16"));
}

TEST(RecognisedRig, knowsTheRateOfTheRotorByThePackets)
{
  SCANLOOM_NEEDS_DATA(vlp16, "other-lidars/Kitware+VeloView/Testing/Data/vlp-16-test-90deg-1-50-frames.pcap");
  const RecognisedRig recognised = recogniseRig(filesOf({vlp16}));  // 50.40 turns in 2.523 s
  EXPECT_THAT(recognised.ini, HasSubstr("lidar1_metadata  = VLP-16 1200 rpm"));
  EXPECT_DOUBLE_EQ(rigFrom(recognised).lidars.at(0).decoder->description().frame_rate, 20);
}

TEST(RecognisedRig, ofOneTurnOfOneLidarGivesAllItsColumnsInOneScan)
{
  SCANLOOM_NEEDS_DATA(captures, "ouster/ouster-lidar+ouster-sdk/tests/pcaps");
  const std::string name = "OS-0-32-U1_v2.2.0_1024x10";
  const Rig rig = rigFrom(recogniseRig(filesOf({captures / (name + ".pcap"), captures / (name + ".json")})));
  RigReplay replay(rig);
  std::vector<std::size_t> columns;
  while (const auto event = replay.next())
    if (const auto* scan = std::get_if<Scan>(&*event)) columns.push_back(scan->columns.size());
  EXPECT_THAT(columns, ElementsAre(1024));
}

TEST(RecognisedRig, knowsAHeliosByItsPackets)
{
  SCANLOOM_NEEDS_DATA(bag,
                      "other-lidars/tier4+nebula/nebula_tests/data/robosense/helios16P/rosbag2_2023_08_03-11_02_46/"
                      "rosbag2_2023_08_03-11_02_46_0.db3");
  const TemporaryFolder folder;
  CaptureWriter writer(folder / "drive.pcap");
  for (const StampedPacket& packet : robosensePacketsOfBag(bag))
  {
    const std::uint16_t port = packet.bytes[0] == 0x55 ? 6699 : 7788;
    writer.write(Datagram{packet.received, IpAddress::parse("192.168.1.200"), port, port, packet.bytes});
  }
  writer.close();
  EXPECT_THAT(recogniseRig(filesOf({folder / "drive.pcap"})).ini,
              AllOf(HasSubstr("lidar1_metadata  = Helios-5515"), HasSubstr("lidar1_port      = 6699")));
}

TEST(RecognisedRig, ofASensorWithAnglesOfItsOwnSaysWhatToWrite)
{
  SCANLOOM_NEEDS_DATA(bag,
                      "other-lidars/tier4+nebula/src/nebula_hesai/nebula_hesai/test_resources/decoder_ground_truth/64/"
                      "1673403880599376836");
  EXPECT_THAT(refusalOf({bag}),
              HasSubstr(R"({"lidar": "hesai", "model": "64", "returns": 2, "angles": "ANGLES.csv"})"));
}

TEST(RecognisedRig, ofACaptureWithoutMetadataSaysWhatItHolds)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const TemporaryFolder bare;
  writeSome(folder / "recording.pcap", bare / "drive.pcap", &isOfLeft);
  EXPECT_THAT(refusalOf({bare / "drive.pcap"}), AllOf(HasSubstr("datagrams of 2304 bytes"), HasSubstr("--metadata")));
}

TEST(RecordingFiles, areRefusedWhereThereIsNoRecording)
{
  const TemporaryFolder empty;
  EXPECT_THAT(refusalOf({empty.path()}), HasSubstr("holds no recording"));
  std::filesystem::create_directory(empty / "lidar");
  EXPECT_THAT(refusalOf({empty.path()}), HasSubstr("name one: " + (empty / "lidar").string()));
  EXPECT_THAT(refusalOf({empty / "nowhere.pcap"}), HasSubstr("no such file"));
  std::ofstream(empty / "notes.txt") << "hello\n";
  EXPECT_THAT(refusalOf({empty / "notes.txt"}), HasSubstr("a text file"));
}
}  // namespace scanloom::recognised_rig_unittest
