/** Lidars over the loopback interface, in real time. Fault cases: see the table in doc/study/faults.md. */
#include "input/lidar/internal/OusterLayout.h"
#include "liveRig.h"
#include "support/RecordedLidars.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/messageOf.h"
#include "support/with.h"

#include <gmock/gmock.h>

#include <set>

namespace scanloom::rig_live_unittest
{
namespace
{
using testing::HasSubstr;
}  // namespace

TEST(RigLive, givesEveryColumnOfTwoLidarsInScansOfTheWholePeriods)
{
  const LiveRig lidars(2);
  RigLive live(lidars.rig);
  const auto datagrams = lidars.drive(1050ms);

  const auto scans = scansIn(sendAndRead(datagrams, live));

  const RigAccount account = live.account();
  ASSERT_GE(scans.size(), 9u);
  for (std::size_t i = 1; i < scans.size(); ++i) EXPECT_EQ(scans[i].start, scans[i - 1].end());
  EXPECT_EQ(account.input.at("datagrams"), datagrams.size());
  std::uint64_t emitted = 0;
  for (const LidarAccount& lidar : account.lidars)
  {
    EXPECT_EQ(lidar.counters.received, datagrams.size() / 2 * 8);
    EXPECT_EQ(lidar.counters.emitted + lidar.counters.before_start, lidar.counters.received);
    emitted += lidar.counters.emitted;
  }
  EXPECT_EQ(columnsIn(scans), emitted);
}

TEST(RigLive, theCaptureMadeOfItGivesTheSameScansToTheBit)
{
  const TemporaryFolder folder;
  LiveRig lidars(3);
  lidars.rig.live.capture = folder / "live.pcap";
  std::vector<SensorEvent> events;
  {
    RigLive live(lidars.rig);
    events = sendAndRead(lidars.drive(1500ms), live);
  }
  ASSERT_GE(events.size(), 14u);
  expectTheSame(events, replayOf(lidars.rig, folder / "live.pcap"));
}

TEST(RigLive, theCaptureGivesTheSameScansWhenDataAreLateBeyondTheDeadline)
{
  const TemporaryFolder folder;
  LiveRig lidars(2);
  lidars.rig.live.capture = folder / "live.pcap";
  lidars.rig.batcher.deadline_ms = 5;
  std::vector<Datagram> datagrams = lidars.drive(1500ms);
  for (std::size_t i = 20; i + 7 < datagrams.size(); i += 20)
    std::rotate(datagrams.begin() + i, datagrams.begin() + i + 1, datagrams.begin() + i + 7);  // one is 30 ms late
  for (std::size_t i = 0; i < datagrams.size(); ++i) datagrams[i].received = Timestamp{} + 5ms * static_cast<int>(i);
  std::vector<SensorEvent> events;
  std::uint64_t late = 0;
  {
    RigLive live(lidars.rig);
    events = sendAndRead(datagrams, live);
    for (const LidarAccount& lidar : live.account().lidars) late += lidar.counters.late;
  }
  EXPECT_GT(late, 0u);
  expectTheSame(events, replayOf(lidars.rig, folder / "live.pcap"));
}

TEST(RigLive, aRecordingOfTwoLidarsWithTheirImusComesOutAsFromItsCapture)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder folder;
  const RecordedLidars lidars(recording, 2000);
  const Configuration configuration = Configuration::fromText(
      lidars.section() + "pcap_output = " + (folder / "live.pcap").string() + "\nbind_address = 127.0.0.1\n",
      "live.ini");
  const Rig rig = makeRig(readRigSettings(configuration, "lidars"));

  std::vector<SensorEvent> events;
  {
    RigLive live(rig);
    events = sendAndRead(lidars.datagrams(), live);
  }
  EXPECT_GE(scansIn(events).size(), 20u);
  EXPECT_GT(events.size(), scansIn(events).size()) << "IMU samples too";
  expectTheSame(events, replayOf(rig, folder / "live.pcap"));
}

TEST(RigLive, aConsumerThatRestsForThreeScansLosesNothing)  // F17
{
  const LiveRig lidars(2);
  RigLive live(lidars.rig);
  std::thread sending(
      [&]
      {
        UdpSender().replay(lidars.drive(1s));
        live.stop();
      });
  std::this_thread::sleep_for(700ms);  // of which the first 0.2 s give no scan
  const auto scans = scansIn(eventsOf(live));
  sending.join();

  EXPECT_GE(scans.size(), 9u);
  EXPECT_EQ(live.account().input.at("scans_dropped"), 0u);
}

TEST(RigLive, aConsumerThatRestsForTenSecondsLosesTheOldestScansAndNothingElse)  // F17
{
  const LiveRig lidars(2);
  RigLive live(lidars.rig);
  const auto datagrams = lidars.drive(10s);

  UdpSender().replay(datagrams);
  live.stop();
  while (!live.receiver().ended()) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(50ms);
  const auto scans = scansIn(eventsOf(live));

  const RigAccount account = live.account();
  ASSERT_EQ(scans.size(), lidars.rig.live.scans_waiting);
  EXPECT_GE(scans.back().end(), Timestamp{1010s}) << "the newest are kept";
  EXPECT_EQ(account.input.at("scans_dropped") + scans.size(), 99u) << "the first period has none";
  EXPECT_EQ(account.input.at("datagrams_dropped_by_kernel"), 0u);
  EXPECT_EQ(account.input.at("datagrams_dropped"), 0u);
  EXPECT_EQ(account.input.at("datagrams"), datagrams.size());
}

TEST(RigLive, foreignDatagramsAreCountedAndChangeNothing)  // F19
{
  const TemporaryFolder folder;
  LiveRig lidars(2);
  lidars.rig.live.capture = folder / "live.pcap";
  const std::uint16_t port = lidars.rig.addresses[0].lidar_port;
  const auto datagrams = lidars.drive(1s);
  std::vector<Datagram> all;
  for (const Datagram& datagram : datagrams)
  {
    Datagram stranger = datagram;  // the size of a lidar's packets, from an address of its own
    stranger.source = IpAddress::parse("127.0.0.9");
    Datagram discovery{datagram.received, IpAddress::parse("127.0.0.10"), 0, port, std::vector<std::uint8_t>(544, 1)};
    all.push_back(stranger);
    all.push_back(datagram);
    all.push_back(discovery);
  }
  RigLive live(lidars.rig);

  const auto events = sendAndRead(all, live);

  EXPECT_EQ(live.account().input.at("datagrams_filtered"), 2 * datagrams.size());
  for (const LidarAccount& lidar : live.account().lidars)
    EXPECT_EQ(lidar.counters.received, datagrams.size() / 2 * 8) << lidar.name;
  expectTheSame(events, replayOf(lidars.rig, folder / "live.pcap"));
}

TEST(RigLive, tellsTwoLidarsOnOnePortApartByTheirAddresses)  // F20
{
  const LiveRig lidars(2, LiveRig::Ports::One);
  RigLive live(lidars.rig);
  const auto datagrams = lidars.drive(1s);

  const auto scans = scansIn(sendAndRead(datagrams, live));

  EXPECT_EQ(live.receiver().ports(), 1u);
  ASSERT_GE(scans.size(), 9u);
  for (std::size_t i = 1; i + 1 < scans.size(); ++i)
    EXPECT_EQ(scans[i].columns_of, (std::vector<std::uint32_t>{64, 64}));
}

TEST(RigLive, tellsTwoLidarsOnOnePortApartByTheirSerialNumbers)  // F20
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const RecordedLidars lidars(recording, 2000, RecordedLidars::Ports::One);
  const Configuration configuration = Configuration::fromText(lidars.section(), "live.ini");
  RigLive live(makeRig(readRigSettings(configuration, "lidars")));

  const auto scans = scansIn(sendAndRead(lidars.datagrams(), live, 4));

  EXPECT_EQ(live.receiver().ports(), 1u);
  EXPECT_GE(scans.size(), 20u);
  const RigAccount account = live.account();
  for (const LidarAccount& lidar : account.lidars)
  {
    const char* address = lidar.name == "left" ? "127.0.0.2" : "127.0.0.3";
    const auto sent = std::count_if(lidars.datagrams().begin(), lidars.datagrams().end(),
                                    [&](const Datagram& datagram)
                                    { return datagram.source.text() == address && datagram.payload.size() > 1000; });
    EXPECT_EQ(lidar.counters.packets, static_cast<std::uint64_t>(sent)) << lidar.name;
  }
  std::uint64_t strangers = 0, ahead = 0;
  for (const auto& [origin, datagrams] : account.unmatched) strangers += datagrams;
  std::set<IpAddress> known;
  for (const Datagram& datagram : lidars.datagrams())
    if (datagram.payload.size() > 1000)
      known.insert(datagram.source);
    else
      ahead += known.count(datagram.source) == 0;
  EXPECT_EQ(strangers, ahead) << "IMU packets bear no serial number: their address is known from a lidar packet's on";
}

/** No addresses are configured. One stranger copies the first lidar, one floods its IMU from the lidar's own address.
 */
TEST(RigLive, aSpoofingAndAFloodingSenderCostAFewPacketsAtTheStart)
{
  const TemporaryFolder folder;
  LiveRig lidars(2, LiveRig::Ports::Several, with(&FakeLidarOptions::has_imu, true));
  const auto datagrams = lidars.drive(2s);
  const std::uint16_t port = lidars.rig.addresses[0].lidar_port;
  const IpAddress stranger = IpAddress::parse("127.0.0.9");
  std::vector<Datagram> all = datagrams;
  const auto add = [&](Duration after, const IpAddress& source, std::vector<std::uint8_t> payload) {
    all.push_back({Timestamp{1000s} + after, source, 0, port, std::move(payload)});
  };
  const auto copies = lidars.lidar->drive(Timestamp{1000s + 100ms}, 2s, 1);
  for (int n = 0; n < 3; ++n) add(-60ms + n * 20ms, stranger, copies[n]);
  for (int n = 0; n < 20; ++n) add(n * 100ms, stranger, copies[8 * n]);
  for (int n = 0; n < 2000; ++n)
    add(20ms + n * 1ms - n % 2 * 1ms, LiveRig::addressOf(0), FakeLidar::imuPacket(Timestamp{n * 1'000'003s}, -1));
  std::stable_sort(all.begin(), all.end(),
                   [](const Datagram& a, const Datagram& b) { return a.received < b.received; });

  for (LidarAddress& address : lidars.rig.addresses) address.source.reset();
  lidars.rig.addresses[0].imu_port = port;
  lidars.rig.live.capture = folder / "live.pcap";
  std::vector<SensorEvent> events;
  RigAccount account;
  std::vector<std::string> warnings;
  {
    RigLive live(lidars.rig);
    events = sendAndRead(all, live);
    account = live.account();
    warnings = live.takeWarnings();
  }

  const std::uint64_t of_each = datagrams.size() / 2;
  EXPECT_GE(account.lidars[0].counters.packets, of_each - 3) << "the stranger's first three came first";
  EXPECT_EQ(account.lidars[1].counters.packets, of_each);
  for (const LidarAccount& lidar : account.lidars) EXPECT_EQ(lidar.counters.late, 0u) << lidar.name;
  EXPECT_GE(account.lidars[0].of_other_senders, 20u);
  EXPECT_GE(account.implausible_imu_samples, 1900u) << "but for those while the stranger was taken for the lidar";
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("127.0.0.9")));
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("imu_samples_implausible")));
  expectTheSame(events, replayOf(lidars.rig, folder / "live.pcap"));
}

/** Of two lidars on one port without addresses: from a stranger, and with serial number 0. */
TEST(RigLive, aPacketThatMayBeOfTwoLidarsIsLeftOutAndTheRunGoesOn)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder folder;
  const RecordedLidars lidars(recording, 2000, RecordedLidars::Ports::One);
  const Configuration configuration =
      Configuration::fromText(lidars.section() + "pcap_output = " + (folder / "live.pcap").string() + "\n", "live.ini");
  const Rig rig = makeRig(readRigSettings(configuration, "lidars"));
  std::vector<Datagram> datagrams = lidars.datagrams();
  const auto some = std::find_if(datagrams.begin() + 1000, datagrams.end(),
                                 [](const Datagram& datagram) { return datagram.payload.size() > 1000; });
  Datagram ambiguous = *some;
  ambiguous.source = IpAddress::parse("127.0.0.9");
  const ByteField serial = headerFields(OusterHeader::Standard).serial;
  std::fill_n(ambiguous.payload.begin() + static_cast<std::ptrdiff_t>(serial.offset), serial.count, 0);
  std::fill_n(ambiguous.payload.end() - 8, 8, 0);  // as firmware that computes no checksum
  datagrams.insert(some, ambiguous);

  std::vector<SensorEvent> events;
  {
    RigLive live(rig);
    events = sendAndRead(datagrams, live);
    EXPECT_EQ(live.account().unmatched.at({ambiguous.destination_port, ambiguous.source}), 1u);
    EXPECT_THAT(live.takeWarnings(), testing::Contains(HasSubstr("may be of 'left' or 'right'")));
  }
  EXPECT_GE(scansIn(events).size(), 20u);
  expectTheSame(events, replayOf(rig, folder / "live.pcap"));
}

TEST(RigLive, givesScansAgainAtOnceAfterThreeSecondsOfSilence)  // F24
{
  const LiveRig lidars(2);
  RigLive live(lidars.rig);
  std::vector<Datagram> datagrams = lidars.drive(4s);
  const Timestamp link_down = datagrams.front().received + 500ms, link_up = link_down + 3s;
  datagrams.erase(std::remove_if(datagrams.begin(), datagrams.end(),
                                 [&](const Datagram& datagram)
                                 { return datagram.received >= link_down && datagram.received < link_up; }),
                  datagrams.end());

  std::thread sending(
      [&]
      {
        UdpSender().replay(datagrams);
        live.stop();
      });
  int empty = 0, full_again = 0;
  while (const auto event = live.next())
  {
    const Scan& scan = std::get<Scan>(*event);
    empty += scan.columns.empty();
    full_again += scan.start >= Timestamp{1003600ms} && scan.columns.size() == 128;
  }
  sending.join();

  EXPECT_GE(empty, 28) << "the rate stays";
  EXPECT_GE(full_again, 3) << "those of the last 0.4 s but the one that the end cuts";
}

TEST(RigLive, saysThatARecordedImuIsNotLive)
{
  LiveRig lidars(1);
  lidars.rig.body_imu.emplace_back();
  EXPECT_THROW(RigLive{lidars.rig}, std::invalid_argument);
}

TEST(RigLive, doesNotReplaceACapture)
{
  const TemporaryFolder folder;
  LiveRig lidars(1);
  lidars.rig.live.capture = folder / "live.pcap";
  std::ofstream(folder / "live.pcap") << "precious";
  EXPECT_THAT(messageOf([&] { RigLive live(lidars.rig); }), HasSubstr("live.pcap exists"));
  EXPECT_EQ(contentOf(folder / "live.pcap"), "precious");
}

TEST(RigStream, givesEachSliceBeforeTheScanThatHoldsItAgain)
{
  LiveRig lidars(2);
  lidars.rig.batcher.slices = 4;
  RigStream stream(lidars.rig, RigStream::ReceiveTimes::Steady);
  std::vector<Scan> parts, scans;
  for (const SensorEvent& event : eventsOf(stream, lidars.drive(1s)))
  {
    if (const auto* part = std::get_if<ScanPart>(&event)) parts.push_back(part->scan);
    const auto* scan = std::get_if<Scan>(&event);
    if (!scan) continue;
    scans.push_back(*scan);
    ASSERT_EQ(parts.size(), 4 * scans.size());
    EXPECT_EQ(parts.back().end(), scan->end());
  }
  ASSERT_GE(scans.size(), 8u);
  EXPECT_EQ(columnsIn(parts), columnsIn(scans));
}
}  // namespace scanloom::rig_live_unittest
