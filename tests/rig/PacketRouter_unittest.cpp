#include "rig/PacketRouter.h"

#include "lidar/LidarModels.h"
#include "packets/CaptureReader.h"
#include "support/TestData.h"

#include <gmock/gmock.h>

namespace scanloom
{
namespace
{
using testing::HasSubstr;

/** Packets of two letters: what it is (L, I, bad Crc, anything else) and whose, '-' where the format has no serial. */
class FakeDecoder : public PacketDecoder
{
 public:
  explicit FakeDecoder(char serial) : serial_(serial) {}

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
  PacketHeader header(Bytes) const override { return {}; }
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

TEST(PacketRouter, asksThePersonWhereLidarPacketsCouldBeOfTwo)
{
  PacketRouter router = twoLidars({7502, 7503, {}}, {7502, 7505, {}});
  try
  {
    router.route(datagram("L-", 7502, "10.0.0.5"));
    FAIL() << "guessed";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_THAT(error.what(), HasSubstr("10.0.0.5 at port 7502"));
    EXPECT_THAT(error.what(), HasSubstr("'left' or 'right'"));
    EXPECT_THAT(error.what(), HasSubstr("'address'"));
  }
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
}  // namespace scanloom
