/** Recorded Hesai packets, alone and beside lidars of three other makers, through a capture into scans. */
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

namespace scanloom::hesai_replay_unittest
{
namespace
{
const std::string kRecordings =
    "other-lidars/tier4+nebula/src/nebula_hesai/nebula_hesai/test_resources/decoder_ground_truth/";

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

struct Outcome
{
  std::vector<Scan> scans;
  std::vector<Column> columns;

  void take(std::vector<Scan> more)
  {
    for (Scan& scan : more)
    {
      columns.insert(columns.end(), scan.columns.begin(), scan.columns.end());
      scans.push_back(std::move(scan));
    }
  }
};

class HesaiReplay : public testing::TestWithParam<const char*>
{
};
INSTANTIATE_TEST_SUITE_P(Models, HesaiReplay, testing::Values("XT32", "40P", "64", "XT16", "QT128"),
                         [](const auto& model) { return std::string(model.param); });
}  // namespace

TEST_P(HesaiReplay, losesNothing)
{
  std::string name = GetParam();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  SCANLOOM_NEEDS_DATA(folder, kRecordings + name);
  const auto decoder = std::shared_ptr<PacketDecoder>(hesaiDecoder(modelNamed(kHesaiModels, GetParam()), 2));
  TimeBatcher batcher({{"roof", decoder, Duration{0}}}, {});
  Outcome outcome;
  for (const Datagram& datagram : captured(datagramsOf(pandarPacketsOfBag(theFile(folder, ".db3")), 2368)))
    outcome.take(push(batcher, 0, datagram.payload, datagram.received));
  outcome.take(batcher.finish());

  const LidarCounters& c = batcher.counters(0);
  EXPECT_EQ(c.received, c.emitted + c.before_start);
  EXPECT_EQ(c.lost + c.doubtful_packets + c.malformed_packets + c.restarts + c.clock_steps, 0u);
  EXPECT_TRUE(batcher.takeNotices().empty());
  for (std::size_t i = 1; i < outcome.columns.size(); ++i)
    EXPECT_NEAR(seconds(outcome.columns[i].stamp - outcome.columns[i - 1].stamp),
                seconds(decoder->description().blockPeriod()), 5e-6);
}

/** Two Ouster, a Velodyne, a Hesai and a Robosense, each recorded elsewhere and by its own clock, as on one machine. */
TEST(MixedReplay, weavesLidarsOfFourMakersIntoOneScan)
{
  SCANLOOM_NEEDS_DATA(ouster, "recordings/sparse");
  SCANLOOM_NEEDS_DATA(velodyne, "other-lidars/Kitware+VeloView/Testing/Data/monterey-first-100-packets.pcap");
  SCANLOOM_NEEDS_DATA(hesai, kRecordings + "xt32");
  SCANLOOM_NEEDS_DATA(robosense, "other-lidars/tier4+nebula/nebula_tests/data/robosense/helios16P");
  std::vector<std::vector<Datagram>> recordings{datagramsOf(ouster / "recording.pcap", 390ms),
                                                datagramsOf(velodyne, 390ms),
                                                datagramsOf(robosensePacketsOfBag(theFile(robosense, ".db3")), 6699),
                                                datagramsOf(pandarPacketsOfBag(theFile(hesai, ".db3")), 2370)};
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
  lidars.push_back({"xt32", hesaiDecoder(modelNamed(kHesaiModels, "XT32"), 2), Duration{0}});
  TimeBatcher batcher(lidars, {});
  Outcome outcome;
  for (const Datagram& datagram : captured(asOfOneDrive(std::move(recordings))))
    if (const auto lidar = index_of_port.find(datagram.destination_port); lidar != index_of_port.end())
      outcome.take(push(batcher, lidar->second, datagram.payload, datagram.received));
  outcome.take(batcher.finish());

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
    EXPECT_GT(batcher.counters(lidar).emitted, 500u) << lidars[lidar].name;
    EXPECT_EQ(batcher.counters(lidar).lost, 0u) << lidars[lidar].name;
  }
}
}  // namespace scanloom::hesai_replay_unittest
