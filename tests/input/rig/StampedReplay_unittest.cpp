/** Packets of lidars of stamps, recorded ones and some at the top of the hour, through the batcher into scans. */
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "../lidar/hesaiPackets.h"
#include "../lidar/velodynePackets.h"
#include "input/batching/TimeBatcher.h"
#include "input/lidar/LidarModels.h"
#include "input/packets/CaptureReader.h"
#include "input/packets/CaptureWriter.h"
#include "support/Rosbag.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/pushPacket.h"

namespace scanloom::stamped_replay_unittest
{
namespace
{
std::vector<Datagram> datagramsOf(std::vector<StampedPacket> packets, std::uint16_t port)
{
  std::vector<Datagram> datagrams;
  for (StampedPacket& packet : packets)
    datagrams.push_back({packet.received, IpAddress::parse("192.168.1.201"), port, port, std::move(packet.bytes)});
  return datagrams;
}

std::vector<Datagram> datagramsOf(const std::filesystem::path& capture, Duration length)
{
  std::vector<Datagram> datagrams;
  CaptureReader reader(capture);
  for (Datagram datagram; reader.next(datagram);)
  {
    if (!datagrams.empty() && datagram.received - datagrams.front().received > length) break;
    datagrams.push_back(datagram);
  }
  return datagrams;
}

/** Through a file, as a person would have it. */
std::vector<Datagram> captured(const std::vector<Datagram>& datagrams)
{
  const TemporaryFolder folder;
  const auto path = folder.path() / "drive.pcap";
  CaptureWriter writer(path);
  for (const Datagram& datagram : datagrams) writer.write(datagram);
  writer.close();
  return datagramsOf(path, Duration::max());
}

/** In the order of arrival, as if all had begun when the last one did. */
std::vector<Datagram> asOfOneDrive(std::vector<std::vector<Datagram>> recordings)
{
  std::vector<Datagram> all;
  const Timestamp start = recordings.back().front().received;
  for (auto& recording : recordings)
  {
    const Duration to_one_start = start - recording.front().received;
    for (Datagram& datagram : recording)
    {
      datagram.received += to_one_start;
      all.push_back(datagram);
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.received < b.received; });
  return all;
}

/** What the batcher makes of the packets that have a lidar here. */
struct Outcome
{
  Outcome(const std::vector<BatchedLidar>& lidars, const std::vector<Datagram>& datagrams,
          const std::map<std::uint16_t, LidarIndex>& lidar_of_port)
  {
    TimeBatcher batcher(lidars, {});
    for (const Datagram& datagram : datagrams)
      if (const auto lidar = lidar_of_port.find(datagram.destination_port); lidar != lidar_of_port.end())
        take(push(batcher, lidar->second, datagram.payload, datagram.received));
    take(batcher.finish());
    for (LidarIndex i = 0; i < lidars.size(); ++i) counters.push_back(batcher.counters(i));
    notices = batcher.takeNotices();
  }

  void take(std::vector<Scan> more)
  {
    for (Scan& scan : more)
    {
      columns.insert(columns.end(), scan.columns.begin(), scan.columns.end());
      scans.push_back(std::move(scan));
    }
  }

  /** Shortest and longest time from one column to the next. */
  std::pair<Duration, Duration> spacing() const
  {
    std::pair<Duration, Duration> range{Duration::max(), Duration{0}};
    for (std::size_t i = 1; i < columns.size(); ++i)
    {
      range.first = std::min(range.first, columns[i].stamp - columns[i - 1].stamp);
      range.second = std::max(range.second, columns[i].stamp - columns[i - 1].stamp);
    }
    return range;
  }

  std::vector<Scan> scans;
  std::vector<Column> columns;
  std::vector<LidarCounters> counters;
  std::vector<Notice> notices;
};

Outcome batchOne(std::shared_ptr<const PacketDecoder> decoder, const std::vector<Datagram>& datagrams)
{
  return {{{"roof", std::move(decoder), Duration{0}}}, datagrams, {{datagrams.front().destination_port, 0}}};
}

void expectNothingMissing(const LidarCounters& c)
{
  EXPECT_EQ(c.received, c.emitted + c.before_start);
  EXPECT_EQ(c.lost + c.doubtful_packets + c.malformed_packets + c.restarts + c.clock_steps, 0u);
}

std::shared_ptr<const PacketDecoder> velodyne(const std::string& model, std::uint8_t product_id = 0, int returns = 1)
{
  VelodyneMetadata metadata = velodyneMetadata(model);
  if (product_id != 0) metadata.product_id = product_id;
  metadata.returns = returns;
  return makeVelodyne(metadata, Rigid::identity());
}

std::shared_ptr<const PacketDecoder> hesai(const char* model)
{
  return hesaiDecoder(modelNamed(kHesaiModels, model), 2);
}

constexpr std::uint8_t kHdl32e = 0x21;  // an early VLP-16 says it, too
constexpr std::uint64_t kAny = 0;

struct Recording
{
  const char* name;
  std::shared_ptr<const PacketDecoder> decoder;
  std::string path;       // a capture, or the folder of a bag
  std::uint64_t packets;  // of the lidar
  Duration wander;        // of columns' stamps
};
void PrintTo(const Recording& recording, std::ostream* out) { *out << recording.name; }

const std::string kHesai =
    "other-lidars/tier4+nebula/src/nebula_hesai/nebula_hesai/test_resources/decoder_ground_truth/";
const std::string kRobosense = "other-lidars/tier4+nebula/nebula_tests/data/robosense/helios16P";
const std::string kVeloView = "other-lidars/Kitware+VeloView/Testing/Data/";

std::vector<Datagram> datagramsOf(const std::filesystem::path& recording)
{
  if (recording.extension() == ".pcap") return datagramsOf(recording, Duration::max());
  const auto bag = theFile(recording, ".db3");
  return datagramsOf(
      recording.string().find("robosense") == std::string::npos ? pandarPacketsOfBag(bag) : robosensePacketsOfBag(bag),
      2368);
}

using StampedReplay = testing::TestWithParam<Recording>;
INSTANTIATE_TEST_SUITE_P(Recordings, StampedReplay,
                         testing::Values(Recording{"XT32", hesai("XT32"), kHesai + "xt32", kAny, 5us},
                                         Recording{"40P", hesai("40P"), kHesai + "40p", kAny, 5us},
                                         Recording{"64", hesai("64"), kHesai + "64", kAny, 5us},
                                         Recording{"XT16", hesai("XT16"), kHesai + "xt16", kAny, 5us},
                                         Recording{"QT128", hesai("QT128"), kHesai + "qt128", kAny, 5us},
                                         Recording{"Helios5515", makeDecoder("Helios-5515", Rigid::identity()),
                                                   kRobosense, 750, 15us},
                                         Recording{"Vlp16", velodyne("vlp16", kHdl32e),
                                                   kVeloView + "vlp-16-test-90deg-1-50-frames.pcap", 1902, 2us},
                                         Recording{"Hdl32e", velodyne("hdl32e", kHdl32e),
                                                   kVeloView + "monterey-first-100-packets.pcap", 2702, 2us}),
                         [](const auto& recording) { return std::string(recording.param.name); });
}  // namespace

TEST_P(StampedReplay, losesNothing)
{
  SCANLOOM_NEEDS_DATA(path, GetParam().path);
  const Outcome outcome = batchOne(GetParam().decoder, captured(datagramsOf(path)));
  expectNothingMissing(outcome.counters[0]);
  if (GetParam().packets != kAny)
  {
    EXPECT_EQ(outcome.counters[0].packets, GetParam().packets);
  }
  EXPECT_TRUE(outcome.notices.empty());
  const Duration period = GetParam().decoder->description().blockPeriod();
  EXPECT_GE(outcome.spacing().first, period - GetParam().wander);
  EXPECT_LE(outcome.spacing().second, period + GetParam().wander);
}

namespace
{
constexpr Timestamp kReceived{1'700'000'000s};

/** Packets of a VLP-16 at 600 rpm; its hour ends after the first second. */
std::vector<Datagram> aroundTheTopOfTheHour(int returns)
{
  std::vector<Datagram> stream;
  const Duration packet = 24 / returns * 55296ns;
  for (Duration t{0}; t < 3s; t += packet)
  {
    VelodyneContent content;
    content.return_mode = returns == 2 ? 0x39 : 0x37;
    const auto us = (3'599'000'000'000 + t.count()) / 1000 % 3'600'000'000;
    content.microseconds = static_cast<std::uint32_t>(us);
    content.azimuth = static_cast<int>(seconds(t) * 360'000) % 36000;
    stream.push_back({kReceived + t + packet + 100us, {}, 0, 2368, velodynePacket(content)});
  }
  return stream;
}
}  // namespace

using VelodyneReturns = testing::TestWithParam<int>;
INSTANTIATE_TEST_SUITE_P(OneAndTwo, VelodyneReturns, testing::Values(1, 2));

TEST_P(VelodyneReturns, passTheTopOfTheHourWithoutAJump)
{
  const Outcome outcome = batchOne(velodyne("vlp16", 0, GetParam()), aroundTheTopOfTheHour(GetParam()));
  expectNothingMissing(outcome.counters[0]);
  EXPECT_TRUE(outcome.notices.empty());
  EXPECT_GE(outcome.spacing().first, 54us) << "stamps are in whole microseconds";
  EXPECT_LE(outcome.spacing().second, 57us);
}

TEST(VelodyneFieldOfView, losesNoBlockBehindItsGap)
{
  std::vector<Datagram> stream;
  Duration t{0};  // of the next sequence; the lasers are on in the first half of each turn
  while (t < 2s)
  {
    VelodyneContent content;
    content.microseconds = static_cast<std::uint32_t>(t.count() / 1000);
    auto packet = velodynePacket(content);
    for (std::size_t block = 0; block < 12; ++block)
    {
      while (t % 100ms >= 50ms) t += 2 * 55296ns;
      store(packet, block * 100 + 2, static_cast<std::uint16_t>(static_cast<int>(seconds(t) * 360'000) % 36000));
      t += 2 * 55296ns;
    }
    stream.push_back({kReceived + t + 100us, {}, 0, 2368, packet});
  }
  const Outcome outcome = batchOne(velodyne("vlp16"), stream);
  EXPECT_EQ(outcome.counters[0].received, outcome.counters[0].emitted + outcome.counters[0].before_start);
  EXPECT_GT(outcome.spacing().first, 50us);
  EXPECT_NEAR(seconds(outcome.spacing().second), 0.05, 1e-3);
}

/** Two Ouster, a Velodyne, a Hesai and a Robosense, each recorded elsewhere and by its own clock, as on one machine. */
TEST(MixedReplay, weavesLidarsOfFourMakersIntoOneScan)
{
  SCANLOOM_NEEDS_DATA(ouster, "recordings/sparse");
  SCANLOOM_NEEDS_DATA(hdl32e, kVeloView + "monterey-first-100-packets.pcap");
  SCANLOOM_NEEDS_DATA(xt32, kHesai + "xt32");
  SCANLOOM_NEEDS_DATA(robosense, kRobosense);
  std::vector<std::vector<Datagram>> recordings{datagramsOf(ouster / "recording.pcap", 390ms),
                                                datagramsOf(hdl32e, 390ms),
                                                datagramsOf(robosensePacketsOfBag(theFile(robosense, ".db3")), 6699),
                                                datagramsOf(pandarPacketsOfBag(theFile(xt32, ".db3")), 2370)};
  const std::vector<std::pair<std::string, std::uint16_t>> sensors{{(ouster / "left.json").string(), 7502},
                                                                   {(ouster / "right.json").string(), 7504},
                                                                   {velodyneFile("hdl32e"), 2368},
                                                                   {"Helios-5515", 6699}};
  std::vector<BatchedLidar> lidars;
  std::map<std::uint16_t, LidarIndex> index_of_port;
  for (const auto& [file, port] : sensors)
  {
    index_of_port[port] = lidars.size();
    lidars.push_back({file, makeDecoder(file, Rigid::identity()), Duration{0}});
  }
  index_of_port[2370] = lidars.size();
  lidars.push_back({"xt32", hesai("XT32"), Duration{0}});
  const Outcome outcome(lidars, captured(asOfOneDrive(std::move(recordings))), index_of_port);

  EXPECT_TRUE(std::is_sorted(outcome.columns.begin(), outcome.columns.end(),
                             [](const Column& a, const Column& b) { return a.stamp < b.stamp; }));
  std::size_t of_all = 0;
  for (const Scan& scan : outcome.scans)
  {
    std::set<std::uint8_t> seen;
    for (std::size_t i = 0; i < scan.points.size(); ++i) seen.insert(scan.points.sensor_id[i]);
    of_all += seen.size() == lidars.size();
  }
  EXPECT_GE(of_all, 2u);
  for (LidarIndex lidar = 0; lidar < lidars.size(); ++lidar)
  {
    EXPECT_GT(outcome.counters[lidar].emitted, 500u) << lidars[lidar].name;
    EXPECT_EQ(outcome.counters[lidar].lost, 0u) << lidars[lidar].name;
  }
}
}  // namespace scanloom::stamped_replay_unittest
