#include "input/rig/PacketRouter.h"

#include "input/lidar/LidarModels.h"
#include "input/packets/CaptureReader.h"
#include "support/TestData.h"

#include <gmock/gmock.h>

namespace scanloom::packet_router_unittest
{
namespace
{
using testing::HasSubstr;

/** Packets of two letters: what it is (L, I, bad Crc, anything else) and whose, '-' where the format has no serial. */
class FakeDecoder : public PacketDecoder
{
 public:
  explicit FakeDecoder(char serial) : serial_(serial)
  {
    description_.columns_per_frame = description_.columns_per_packet = 16;  // a packet a turn
    description_.last_column = 15;
    description_.frame_rate = 100;
    description_.serial = std::to_string(int{serial});
  }

  PacketKind kindByHeader(Bytes packet) const override
  {
    if (packet.size() != 2) return PacketKind::Malformed;
    if (packet[1] != '-' && packet[1] != serial_) return PacketKind::Foreign;
    switch (packet[0])
    {
      case 'L':
      case 'C':
        return PacketKind::Lidar;
      case 'I':
        return PacketKind::Imu;
      default:
        return PacketKind::Malformed;
    }
  }
  bool isIntact(Bytes packet) const override { return packet.size() != 2 || packet[0] != 'C'; }
  const LidarDescription& description() const override { return description_; }
  PacketHeader header(Bytes packet) const override
  {
    PacketHeader header;
    if (packet.size() == 2 && packet[1] != '-') header.serial = packet[1];
    return header;
  }
  void readBlocks(Bytes, std::vector<MeasurementBlock>&) const override {}
  void appendPoints(Bytes, std::size_t, std::int32_t, std::uint8_t, PointCloud&) const override {}
  std::vector<ImuSample> imuSamples(Bytes) const override { return {}; }

 private:
  char serial_;
  LidarDescription description_;
};

const FakeDecoder kLeft('a'), kRight('b');

Datagram datagram(const std::string& packet, std::uint16_t port, const std::string& source = "10.0.0.1")
{
  return {Timestamp{}, IpAddress::parse(source), 4000, port, {packet.begin(), packet.end()}};
}

/** "0L" for a lidar packet of the first lidar, "1I", "0!" for one that it cannot read, "none". */
std::string route(PacketRouter& router, const Datagram& datagram)
{
  const auto routed = router.route(datagram);
  if (!routed) return "none";
  const char* kind = routed->kind == PacketKind::Lidar ? "L" : routed->kind == PacketKind::Imu ? "I" : "!";
  return std::to_string(routed->lidar) + kind;
}

PacketRouter twoLidars(LidarAddress left, LidarAddress right)
{
  return PacketRouter({{"left", left, &kLeft}, {"right", right, &kRight}});
}

TEST(PacketRouter, tellsLidarsApartByPort)
{
  PacketRouter router = twoLidars({7502, 7503, {}}, {7504, 7505, {}});
  EXPECT_EQ(route(router, datagram("L-", 7502)), "0L");
  EXPECT_EQ(route(router, datagram("I-", 7503)), "0I");
  EXPECT_EQ(route(router, datagram("L-", 7504)), "1L");
  EXPECT_EQ(route(router, datagram("I-", 7505)), "1I");
  EXPECT_EQ(route(router, datagram("??", 7504)), "none");
  EXPECT_EQ(route(router, datagram("?b", 7504)), "1!");
}

Datagram message(const std::string& packet, const std::string& topic)
{
  return {Timestamp{}, {}, 0, 0, {packet.begin(), packet.end()}, topic};
}

LidarAddress onTopics(const std::string& key, const std::string& topic, const std::string& imu_topic)
{
  LidarAddress address;
  address.key = key;
  address.topic = topic;
  address.imu_topic = imu_topic;
  return address;
}

TEST(PacketRouter, tellsLidarsOfBagsApartByTopic)
{
  PacketRouter router = twoLidars(onTopics("lidar1", "/l", "/l/imu"), onTopics("lidar2", "/r", ""));
  EXPECT_EQ(route(router, message("L-", "/l")), "0L");
  EXPECT_EQ(route(router, message("I-", "/l/imu")), "0I");
  EXPECT_EQ(route(router, message("L-", "/r")), "1L");
  EXPECT_EQ(route(router, datagram("L-", 7502)), "none");
  EXPECT_EQ(route(router, message("DDS", "/other")), "none");
  EXPECT_EQ(router.unmatched().count({0, {}, "/other"}), 1u);
}

TEST(PacketRouter, namesTheTopicToSetIfALidarIsHeardOnAnotherOneOnly)
{
  PacketRouter router = twoLidars(onTopics("lidar1", "/l", ""), onTopics("lidar2", "/wrong", ""));
  for (int i = 0; i < 60; ++i)
  {
    route(router, message("La", "/l"));
    EXPECT_EQ(route(router, message("Lb", "/r")), "none");
  }
  EXPECT_THAT(router.takeWarnings(),
              testing::ElementsAre("lidar 'right': its packets come on topic /r: set lidar2_topic = /r"));
}

TEST(PacketRouter, countsByPortAndSourceWhatIsNoLidars)
{
  PacketRouter router = twoLidars({7502, 7503, {}}, {7504, 7505, {}});
  route(router, datagram("DDS", 7400, "10.0.0.7"));
  route(router, datagram("DDS", 7400, "10.0.0.7"));
  route(router, datagram("Lc", 7502, "10.0.0.9"));
  const std::map<Origin, std::uint64_t> expected{{{7400, IpAddress::parse("10.0.0.7")}, 2},
                                                 {{7502, IpAddress::parse("10.0.0.9")}, 1}};
  EXPECT_TRUE(router.unmatched() == expected);
}

TEST(PacketRouter, namesThePortToSetIfALidarIsHeardAtAnotherOneOnly)
{
  PacketRouter router({{"left", {7502, 7503, {}, "lidar1"}, &kLeft}, {"right", {9999, 9998, {}, "lidar2"}, &kRight}});
  for (int i = 0; i < 200; ++i)
  {
    route(router, datagram("La", 7502));
    EXPECT_EQ(route(router, datagram("Lb", 7504)), "none");
    EXPECT_EQ(route(router, datagram("Ib", 7505)), "none");
    route(router, datagram("La", 8502));  // a copy of what is heard
    route(router, datagram("Lc", 7504));
  }
  EXPECT_THAT(router.takeWarnings(),
              testing::UnorderedElementsAre(
                  "lidar 'right': its packets come to port 7504, not to 9999: set lidar2_port = 7504",
                  "lidar 'right': its IMU packets come to port 7505, not to 9998: set lidar2_imu_port = 7505"));
}

TEST(PacketRouter, namesBothSerialNumbersIfAnotherSensorSendsToThePortOfALidar)
{
  PacketRouter router({{"left", {7502, 7503, {}, "lidar1"}, &kLeft}, {"right", {7504, 7505, {}, "lidar2"}, &kRight}});
  for (int i = 0; i < 200; ++i)
  {
    route(router, datagram("La", 7502));
    route(router, datagram("Lc", 7502));  // beside packets of its own
    route(router, datagram("Lc", 7504));
    route(router, datagram("Ib", 7503));  // of a sensor that is not there
  }
  EXPECT_THAT(router.takeWarnings(), testing::ElementsAre("lidar 'right': packets to port 7504 are of serial number "
                                                          "99, its metadata are of 98: give those of 99"));
}

TEST(PacketRouter, tellsLidarsOnOnePortApartBySerial)
{
  PacketRouter router = twoLidars({7502, 7502, {}}, {7502, 7502, {}});
  EXPECT_EQ(route(router, datagram("La", 7502)), "0L");
  EXPECT_EQ(route(router, datagram("Lb", 7502)), "1L");
  EXPECT_EQ(route(router, datagram("Cb", 7502)), "1!");
  EXPECT_EQ(route(router, datagram("Lc", 7502)), "none");
}

TEST(PacketRouter, tellsLidarsOnOnePortApartByConfiguredSource)
{
  PacketRouter both = twoLidars({7502, 7503, IpAddress::parse("10.0.0.1")}, {7502, 7503, IpAddress::parse("10.0.0.2")});
  EXPECT_EQ(route(both, datagram("L-", 7502, "10.0.0.1")), "0L");
  EXPECT_EQ(route(both, datagram("L-", 7502, "10.0.0.2")), "1L");
  EXPECT_EQ(route(both, datagram("L-", 7502, "10.0.0.3")), "none");

  PacketRouter one = twoLidars({7502, 7503, IpAddress::parse("10.0.0.1")}, {7502, 7503, {}});
  EXPECT_EQ(route(one, datagram("L-", 7502, "10.0.0.1")), "0L");
  EXPECT_EQ(route(one, datagram("L-", 7502, "10.0.0.2")), "1L");
}

TEST(PacketRouter, givesImuPacketsWithoutSerialToTheLidarThatSendsFromThere)
{
  PacketRouter router = twoLidars({7502, 7502, {}}, {7502, 7502, {}});
  EXPECT_EQ(route(router, datagram("I-", 7502, "10.0.0.2")), "none");  // nobody is known yet
  EXPECT_EQ(route(router, datagram("La", 7502, "10.0.0.1")), "0L");
  EXPECT_EQ(route(router, datagram("Lb", 7502, "10.0.0.2")), "1L");
  EXPECT_EQ(route(router, datagram("I-", 7502, "10.0.0.2")), "1I");
  EXPECT_EQ(route(router, datagram("I-", 7502, "10.0.0.1")), "0I");
}

TEST(PacketRouter, doesNotGuessAnImuWhenTwoLidarsSendFromOneAddress)
{
  PacketRouter router = twoLidars({7502, 7503, {}}, {7504, 7503, {}});
  route(router, datagram("La", 7502));
  route(router, datagram("Lb", 7504));
  EXPECT_EQ(route(router, datagram("I-", 7503)), "none");
}

TEST(PacketRouter, leavesOutAndTellsOnceWhatCouldBeOfTwoLidars)
{
  PacketRouter router = twoLidars({7502, 7503, {}}, {7502, 7505, {}});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(route(router, datagram("L-", 7502, "10.0.0.5")), "none");
  EXPECT_EQ(route(router, datagram("La", 7502, "10.0.0.1")), "0L") << "the others go on";
  EXPECT_EQ(router.unmatched().at({7502, IpAddress::parse("10.0.0.5")}), 3u);
  EXPECT_THAT(router.takeWarnings(),
              testing::ElementsAre(testing::AllOf(HasSubstr("10.0.0.5 at port 7502"), HasSubstr("'left' or 'right'"),
                                                  HasSubstr("'address'"))));
}

TEST(PacketRouter, keepsTheFirstSenderOfASerialNumberAndTellsOfAnother)
{
  PacketRouter router = twoLidars({7502, 7502, {}}, {7502, 7502, {}});
  EXPECT_EQ(route(router, datagram("La", 7502, "10.0.0.1")), "0L");
  EXPECT_EQ(route(router, datagram("La", 7502, "10.0.0.9")), "none");
  EXPECT_EQ(route(router, datagram("Ia", 7502, "10.0.0.9")), "none");
  EXPECT_EQ(route(router, datagram("La", 7502, "10.0.0.1")), "0L");
  EXPECT_EQ(router.ofOtherSenders(0), 2u);
  EXPECT_EQ(router.ofOtherSenders(1), 0u);
  EXPECT_EQ(router.unmatched().at({7502, IpAddress::parse("10.0.0.9")}), 2u);
  EXPECT_THAT(router.takeWarnings(),
              testing::ElementsAre(testing::AllOf(HasSubstr("'left'"), HasSubstr("10.0.0.9"), HasSubstr("10.0.0.1"),
                                                  HasSubstr("'address'"))));
}

TEST(PacketRouter, followsALidarToANewAddressOnceTheOldOneIsSilent)
{
  PacketRouter router = twoLidars({7502, 7502, {}}, {7504, 7504, {}});
  const auto at = [](Duration time, const char* source)
  {
    Datagram d = datagram("La", 7502, source);
    d.received = Timestamp{time};
    return d;
  };
  for (int turn = 0; turn < 100; ++turn) EXPECT_EQ(route(router, at(turn * 10ms, "10.0.0.1")), "0L");
  EXPECT_EQ(route(router, at(1s, "10.0.0.2")), "none");
  EXPECT_EQ(route(router, at(3s, "10.0.0.2")), "0L");
  const auto taken_over = router.route(at(3010ms, "10.0.0.2"));
  ASSERT_TRUE(taken_over);
  EXPECT_FALSE(taken_over->of_new_sender) << "that was the packet before";
  EXPECT_EQ(route(router, at(3020ms, "10.0.0.1")), "none");
}

TEST(PacketRouter, needsAPortForEveryLidar) { EXPECT_THROW(twoLidars({7502, 0, {}}, {}), std::invalid_argument); }

constexpr const char* kOuster = "ouster/ouster-lidar+ouster-sdk/tests/pcaps/";
constexpr const char* kOs1 = "169.254.238.111";
constexpr const char* kOs0 = "169.254.92.158";

/** An OS0 with serial in its packets and an OS1 of legacy format on one port; both IMU packets come before any lidar
 * packet. */
TEST(PacketRouter, tellsTwoRealSensorsOnOnePortApart)
{
  SCANLOOM_NEEDS_DATA(first, std::string(kOuster) + "same_ports.1.json");
  SCANLOOM_NEEDS_DATA(second, std::string(kOuster) + "same_ports.2.json");
  SCANLOOM_NEEDS_DATA(capture, std::string(kOuster) + "same_ports.pcap");
  const auto a = makeDecoder(first.string(), Rigid::identity()), b = makeDecoder(second.string(), Rigid::identity());
  PacketRouter router({{"a", {7502, 7502, {}}, a.get()}, {"b", {7502, 7502, {}}, b.get()}});

  std::map<std::string, std::string> routes;
  CaptureReader reader(capture);
  for (Datagram d; reader.next(d);) routes[d.source.text()] += route(router, d) + " ";
  CaptureReader again(capture);
  for (Datagram d; again.next(d);) routes[d.source.text()] += route(router, d) + " ";

  EXPECT_EQ(routes[kOs1], "none 1L 1I 1L ");
  EXPECT_EQ(routes[kOs0], "none 0L 0I 0L ");
}

/** Both of legacy format: the packet's size tells the 64 channels from the 128. */
TEST(PacketRouter, tellsTwoRealLegacySensorsOfDifferentSizeApart)
{
  SCANLOOM_NEEDS_DATA(first, std::string(kOuster) + "same_ports_legacy.1.json");
  SCANLOOM_NEEDS_DATA(second, std::string(kOuster) + "same_ports_legacy.2.json");
  SCANLOOM_NEEDS_DATA(capture, std::string(kOuster) + "same_ports_legacy.pcap");
  const auto a = makeDecoder(first.string(), Rigid::identity()), b = makeDecoder(second.string(), Rigid::identity());
  PacketRouter router({{"a", {7502, 7502, {}}, a.get()}, {"b", {7502, 7502, {}}, b.get()}});

  std::map<std::string, std::string> routes;
  CaptureReader reader(capture);
  for (Datagram d; reader.next(d);) routes[d.source.text()] += route(router, d);
  EXPECT_EQ(routes[kOs1], "1L");
  EXPECT_EQ(routes[kOs0], "0L");
}
}  // namespace
}  // namespace scanloom::packet_router_unittest
