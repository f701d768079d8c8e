/** Rawlogs of stock MRPT as bags. */
#include "input/bags/internal/RawlogBag.h"

#include <gmock/gmock.h>

#include "../lidar/captures.h"
#include "input/bags/BagContents.h"
#include "input/bags/BagPackets.h"
#include "input/rawlogs/Conversions.h"
#include "input/rawlogs/ImuObservation.h"
#include "support/PacketRawlogFile.h"
#include "support/TemporaryFolder.h"

namespace scanloom::rawlog_bag_unittest
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;

const Timestamp kBegin = fromNanoseconds(1'700'000'000'000'000'000);
const std::vector<std::uint8_t> kPacket(1206, 7);

mrpt::obs::CObservationVelodyneScan::Ptr turnAt(Duration after_begin, const std::string& label,
                                                const mrpt::poses::CPose3D& pose = {})
{
  return velodyneScan({kPacket}, toMrpt(kBegin + after_begin), label, pose);
}
}  // namespace

TEST(RawlogBag, holdsTheSensorsByTheirLabelsAndPoses)
{
  const TemporaryFolder folder;
  const Rigid body_T_imu = Rigid::fromXyzYawPitchRoll(0, 0, 1, 0, 0, 0);
  const ImuSample sample{kBegin + 5ms, {1, 2, 3}, {0.1, 0.2, 0.3}};
  writeRawlog(folder / "drive.rawlog", {turnAt(0s, "rear", mrpt::poses::CPose3D(-1, 0, 2, 3, 0, 0)),
                                        toObservation(sample, body_T_imu, "xsens"), turnAt(100ms, "rear")});

  const BagContents contents = contentsOf({folder / "drive.rawlog"});
  ASSERT_EQ(contents.topics.size(), 3U);
  EXPECT_EQ(contents.topics[1].name, "rear");
  EXPECT_EQ(contents.topics[1].messages, 2U);
  const auto rear = contents.frames.transform("base_link", "rear");
  ASSERT_TRUE(rear);
  EXPECT_NEAR((rear->translation - Eigen::Vector3d(-1, 0, 2)).norm(), 0, 1e-9);
  EXPECT_NEAR(contents.frames.transform("base_link", "xsens")->translation.z(), 1, 1e-9);
  const auto imu = readBagImu({folder / "drive.rawlog"}, "xsens").samples;
  ASSERT_EQ(imu.size(), 1U);
  EXPECT_EQ(imu[0].stamp, sample.stamp);
  EXPECT_EQ(imu[0].accel, sample.accel);
  EXPECT_EQ(imu[0].gyro, sample.gyro);
}

TEST(RawlogBag, givesThePacketsOfTheCaptureThatItWasMadeOf)
{
  SCANLOOM_NEEDS_DATA(capture, "other-lidars/MRPT+mrpt/modules/mrpt_data/tests/sample_velodyne_hdl32.pcap");
  const VelodynePackets packets = payloadsOf(capture);
  const TemporaryFolder folder;
  std::vector<mrpt::serialization::CSerializable::Ptr> turns;
  constexpr std::size_t kTurn = 181;
  for (std::size_t begin = 0; begin < packets.size(); begin += kTurn)
  {
    const auto end = packets.begin() + static_cast<std::ptrdiff_t>(std::min(begin + kTurn, packets.size()));
    turns.push_back(velodyneScan({packets.begin() + static_cast<std::ptrdiff_t>(begin), end},
                                 toMrpt(kBegin + turns.size() * 100ms), "front"));
  }
  writeRawlog(folder / "drive.rawlog", turns);

  const auto readers = datagramsOf({folder / "drive.rawlog"});
  VelodynePackets found;
  for (Datagram datagram; readers.front()->next(datagram);) found.push_back(datagram.payload);
  EXPECT_EQ(found, packets);
}

TEST(RawlogBag, leavesOutALidarThatComesTooLateAndSaysSo)
{
  const TemporaryFolder folder;
  writeRawlog(folder / "drive.rawlog", {turnAt(0s, "front"), turnAt(11s, "rear"), turnAt(11100ms, "rear")});

  const auto bag = openRawlogBag(folder / "drive.rawlog");
  std::vector<std::string> seen;
  for (BagMessage message; bag->next(message);) seen.push_back(bag->topics()[message.topic].name);
  EXPECT_THAT(seen, ElementsAre("/tf_static", "front"));
  EXPECT_THAT(bag->takeWarnings(), ElementsAre(HasSubstr("'rear' begins more than 10 s after the first object")));
}

TEST(RawlogBag, isReadUpToWhereTheFileIsCut)
{
  const TemporaryFolder folder;
  const auto file = folder / "drive.rawlog";
  writeRawlog(file, {turnAt(0s, "front"), turnAt(100ms, "front")});
  const std::string whole = contentOf(file);
  std::ofstream(file, std::ios::binary) << whole.substr(0, whole.size() - 100);

  const auto bag = openRawlogBag(file);
  std::size_t turns = 0;
  for (BagMessage message; bag->next(message);) turns += message.topic == 1;
  EXPECT_EQ(turns, 1U);
  EXPECT_THAT(bag->takeWarnings(), ElementsAre(HasSubstr("after 1 objects")));
}
}  // namespace scanloom::rawlog_bag_unittest
