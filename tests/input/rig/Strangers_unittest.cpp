/** Other senders than the lidars: what they cost, on a virtual clock. Over the network: RigLive_unittest.cpp. */
#include "liveRig.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <ostream>
#include <random>

namespace scanloom::strangers_unittest
{
namespace
{
using Datagrams = std::vector<Datagram>;

constexpr Timestamp kFirst{1000s};
constexpr Duration kTurn = 100ms, kLength = 4s;
constexpr int kBlocksOfPacket = 16;
constexpr Duration kYear = std::chrono::hours{24 * 365};

const IpAddress kStranger = IpAddress::parse("10.9.9.9");

/** Two lidars like OS-128, each on a port of its own, without configured addresses. */
struct OpenRig
{
  OpenRig()
  {
    FakeLidarOptions options;
    options.columns_per_frame = 1024;
    options.columns_per_packet = kBlocksOfPacket;
    options.last_column = 1023;
    options.has_imu = true;
    lidar = std::make_shared<FakeLidar>(options);
    for (const std::uint16_t i : {0, 1})
    {
      rig.lidars.push_back({i == 0 ? "left" : "right", lidar, {}});
      rig.addresses.push_back({static_cast<std::uint16_t>(7502 + i), 0, std::nullopt});
      rig.addresses.back().imu_port = rig.addresses.back().lidar_port;
    }
  }

  /** What both send in so many turns; a packet arrives 0.3 to 0.7 ms after its last block. */
  Datagrams drive(int first_turn = 0, int turns = kLength / kTurn) const
  {
    Datagrams all;
    for (std::size_t i = 0; i < 2; ++i)
    {
      const Duration packet = lidar->description().blockPeriod() * kBlocksOfPacket;
      Timestamp end = kFirst + 1317us * static_cast<int>(i) + first_turn * kTurn;
      int n = 0;
      for (auto& payload : lidar->drive(end, turns * kTurn, static_cast<std::uint32_t>(7 + first_turn)))
        all.push_back({(end += packet) + 300us + 100us * (++n % 5), senderOf(i), 0, rig.addresses[i].lidar_port,
                       std::move(payload)});
    }
    inOrder(all);
    return all;
  }

  static IpAddress senderOf(std::size_t lidar) { return IpAddress::parse(lidar == 0 ? "10.0.0.1" : "10.0.0.2"); }

  static void inOrder(Datagrams& datagrams)
  {
    std::stable_sort(datagrams.begin(), datagrams.end(),
                     [](const Datagram& a, const Datagram& b) { return a.received < b.received; });
  }

  std::shared_ptr<const FakeLidar> lidar;
  Rig rig;
};

struct Batched
{
  RigAccount account;
  std::vector<std::string> warnings;
  std::vector<SensorEvent> events;

  const LidarCounters& of(std::size_t lidar) const { return account.lidars[lidar].counters; }
};

Batched runOf(const Rig& rig, const Datagrams& datagrams)
{
  RigStream stream(rig, RigStream::ReceiveTimes::Steady);
  std::vector<SensorEvent> events = eventsOf(stream, datagrams);
  return {stream.account(), stream.takeWarnings(), std::move(events)};
}

/** The left lidar's n-th packet with every stamp, and its ids where turns are given, moved ahead. */
Datagram copyOf(const OpenRig& rig, int n, Duration stamps, int turns, Timestamp received)
{
  constexpr int kPacketsOfTurn = 64;
  const int turn = n / kPacketsOfTurn;
  const auto packets =
      rig.lidar->drive(kFirst + stamps + turn * 100ms, 100ms, static_cast<std::uint32_t>(7 + turns + turn));
  return {received, kStranger, 0, rig.rig.addresses[0].lidar_port,
          packets[static_cast<std::size_t>(n % kPacketsOfTurn)]};
}

struct Attack
{
  const char* name;
  std::function<Datagrams(const OpenRig&)> packets;
  double most_lost;  // share of the left lidar's blocks
};
std::ostream& operator<<(std::ostream& os, const Attack& attack) { return os << attack.name; }

Datagrams aYearAheadBeforeTheStart(const OpenRig& rig)
{
  Datagrams packets;
  for (int n = 0; n < 3; ++n) packets.push_back(copyOf(rig, n, kYear, 0, kFirst - 500ms + n * 2ms));
  return packets;
}

Datagrams rightStampsJustBeforeTheStart(const OpenRig& rig)
{
  Datagrams packets;
  for (int n = 0; n < 3; ++n) packets.push_back(copyOf(rig, n, 200ms, 2, kFirst - 30ms + n * 2ms));
  return packets;
}

Datagrams twentyFarAhead(const OpenRig& rig)
{
  Datagrams packets;
  for (int n = 0; n < 20; ++n) packets.push_back(copyOf(rig, 640 + n, kYear, 0, kFirst + 1s + n * 200us));
  return packets;
}

Datagrams tenASecondALittleAhead(const OpenRig& rig)
{
  Datagrams packets;
  for (int n = 0; n < 35; ++n) packets.push_back(copyOf(rig, 64 * n, 100ms, 1, kFirst + 3ms + n * 100ms));
  return packets;
}

Datagrams tenASecondFromFiveSecondsBeforeTheStart(const OpenRig& rig)
{
  Datagrams packets;
  const auto copies = rig.lidar->drive(kFirst - 5s + kYear, 5s + kLength, 7);
  for (std::size_t n = 0; n < 85; ++n)
    packets.push_back({kFirst - 5s + 3ms + static_cast<int>(n) * 100ms, kStranger, 0, rig.rig.addresses[0].lidar_port,
                       copies[64 * n]});
  return packets;
}

Datagrams tenPairsASecondFarAhead(const OpenRig& rig)
{
  Datagrams packets;
  for (int n = 0; n < 35; ++n)
    for (int k = 0; k < 2; ++k)
      packets.push_back(copyOf(rig, 64 * n + k, kYear, 0, kFirst + 3ms + n * 100ms + k * 50us));
  return packets;
}

using Strangers = testing::TestWithParam<Attack>;
INSTANTIATE_TEST_SUITE_P(Copies, Strangers,
                         testing::Values(Attack{"threeAYearAheadBeforeTheStart", aYearAheadBeforeTheStart, 0.005},
                                         Attack{"threeJustBeforeTheStart", rightStampsJustBeforeTheStart, 0.005},
                                         Attack{"twentyFarAhead", twentyFarAhead, 0},
                                         Attack{"tenASecondALittleAhead", tenASecondALittleAhead, 0},
                                         Attack{"tenASecondFromFiveSecondsBeforeTheStart",
                                                tenASecondFromFiveSecondsBeforeTheStart, 0.005},
                                         Attack{"tenPairsASecondFarAhead", tenPairsASecondFarAhead, 0}),
                         [](const auto& attack) { return std::string(attack.param.name); });

/** Of the time of the drive: a stranger's are elsewhere. */
std::size_t columnsOf(std::size_t lidar, const Batched& run)
{
  std::size_t columns = 0;
  for (const SensorEvent& event : run.events)
    if (const auto* scan = std::get_if<Scan>(&event))
      columns += static_cast<std::size_t>(std::count_if(
          scan->columns.begin(), scan->columns.end(),
          [&](const Column& column) { return column.sensor_id == lidar && column.stamp < kFirst + kLength + 1s; }));
  return columns;
}

/** Against a run without strangers. A figure for the table of doc/study/faults.md, too. */
double shareLost(std::size_t lidar, const Batched& run, const Batched& calm)
{
  const double lost = 1 - static_cast<double>(columnsOf(lidar, run)) / static_cast<double>(columnsOf(lidar, calm));
  testing::Test::RecordProperty(fmt::format("lost_percent_of_{}", run.account.lidars[lidar].name),
                                fmt::format("{:.2f}", 100 * lost));
  return lost;
}

std::string summaryOf(const Batched& run)
{
  std::string text;
  for (const auto& [name, count] : countsOf(run.account))
    if (count > 0) text += name + "=" + std::to_string(count) + " ";
  for (const std::string& warning : run.warnings) text += "\n  " + warning;
  return text;
}
}  // namespace

TEST_P(Strangers, takeNothingFromALidarThatIsHeard)
{
  const OpenRig rig;
  Datagrams datagrams = rig.drive();
  const Batched calm = runOf(rig.rig, datagrams);
  for (Datagram& packet : GetParam().packets(rig)) datagrams.push_back(std::move(packet));
  OpenRig::inOrder(datagrams);

  const Batched run = runOf(rig.rig, datagrams);

  EXPECT_LE(shareLost(0, run, calm), GetParam().most_lost) << summaryOf(run);
  EXPECT_LE(shareLost(1, run, calm), 0) << summaryOf(run);
  for (const SensorEvent& event : run.events)
    if (const auto* scan = std::get_if<Scan>(&event))
    {
      EXPECT_LT(scan->start, kFirst + kLength + 1s) << "the lidars' time is kept";
    }
}

TEST_P(Strangers, withALidarsOwnAddressTakeLittle)
{
  const OpenRig rig;
  Datagrams datagrams = rig.drive();
  const Batched calm = runOf(rig.rig, datagrams);
  for (Datagram& packet : GetParam().packets(rig))
  {
    packet.source = OpenRig::senderOf(0);
    datagrams.push_back(std::move(packet));
  }
  OpenRig::inOrder(datagrams);

  const Batched run = runOf(rig.rig, datagrams);

  EXPECT_LE(shareLost(0, run, calm), 0.02) << summaryOf(run);
  EXPECT_LE(shareLost(1, run, calm), 0.02) << summaryOf(run);
}

/** Bursts of copies of any length at any time. Every other attack copies what the lidar sends about now. Seed 1. */
TEST(Strangers, ofAnyKindTakeNothingAndWithTheLidarsAddressLittle)
{
  const OpenRig rig;
  const Datagrams drive = rig.drive();
  const Batched calm = runOf(rig.rig, drive);
  std::mt19937 random(1);  // NOLINT: the same every time
  const auto upTo = [&random](int most) { return static_cast<int>(random() % static_cast<unsigned>(most + 1)); };
  for (int n = 0; n < 60; ++n)
  {
    Datagrams datagrams = drive;
    const bool about_now = n % 2 == 0;
    const Duration ahead = about_now ? Duration{0} : upTo(1) * kYear + (upTo(4000) - 2000) * 1ms;
    const int bursts = 1 + upTo(9), length = 1 + upTo(29), turns = about_now ? 0 : upTo(3), sooner = upTo(400) - 200;
    for (int b = 0; b < bursts; ++b)
    {
      const Timestamp received = kFirst + (500 + upTo(3000)) * 1ms;
      const int now = static_cast<int>((received - kFirst) / 1562500ns);
      for (int k = 0; k < length; ++k)
        datagrams.push_back(
            copyOf(rig, (about_now ? now + sooner : upTo(2000)) + k, ahead, turns, received + k * 100us));
    }
    OpenRig::inOrder(datagrams);
    const Batched run = runOf(rig.rig, datagrams);
    EXPECT_LE(shareLost(0, run, calm), 0) << n << ": " << summaryOf(run);
    EXPECT_LE(shareLost(1, run, calm), 0) << n << ": " << summaryOf(run);
    if (about_now) continue;  // with the lidar's address these are the lidar's for all that can be known
    for (Datagram& datagram : datagrams)
      if (datagram.source == kStranger) datagram.source = OpenRig::senderOf(0);
    const Batched forged = runOf(rig.rig, datagrams);
    EXPECT_LE(shareLost(0, forged, calm), 0.001) << n << ": " << summaryOf(forged);
    EXPECT_LE(shareLost(1, forged, calm), 0.001) << n << ": " << summaryOf(forged);
  }
}

/** A stranger at work in ten seconds of a drive: pairs of copies, far ahead and about now, noise, and a flood of IMU
 * packets with any stamps. */
Datagrams tenSecondsOfStrangers(const OpenRig& rig, int first_turn, std::mt19937_64& random)
{
  const Timestamp begin = kFirst + first_turn * kTurn;
  const std::uint16_t port = rig.rig.addresses[0].lidar_port;
  Datagrams packets;
  for (int n = 0; n < 100; ++n)
    for (int k = 0; k < 2; ++k)
      packets.push_back(copyOf(rig, 64 * (first_turn + n) + k, n % 2 == 0 ? kYear : Duration{0}, n % 3,
                               begin + n * kTurn + 3ms + k * 50us));
  for (int n = 0; n < 10'000; ++n)
  {
    const Timestamp received = begin + n * 1ms + 70us;
    const Timestamp any{Duration{static_cast<std::int64_t>(random() >> 3)}};
    packets.push_back({received, kStranger, 0, port, FakeLidar::imuPacket(any, -1)});
    if (n % 10 == 0)
      packets.push_back({received, kStranger, 0, port, std::vector<std::uint8_t>(random() % 1500, 0xA5)});
  }
  return packets;
}

/** Hours of it with SCANLOOM_HOURS=24, otherwise a minute. Seed 2. */
TEST(Strangers, thatStayForHoursTakeNothing)
{
  const char* hours = std::getenv("SCANLOOM_HOURS");
  const int pieces = hours ? static_cast<int>(360 * std::stod(hours)) : 6;
  constexpr int kTurns = 100;
  const OpenRig rig;
  std::mt19937_64 random(2);
  RigStream stream(rig.rig, RigStream::ReceiveTimes::Steady);
  const Timestamp from = kFirst + kTurns * kTurn, to = kFirst + (pieces - 1) * kTurns * kTurn;
  std::array<std::int64_t, 2> columns{}, sent{};
  std::size_t most_warnings = 0;
  const auto collect = [&]
  {
    while (auto event = stream.next())
      if (const auto* scan = std::get_if<Scan>(&*event))
        for (const Column& column : scan->columns)
          if (column.stamp >= from && column.stamp < to) ++columns[column.sensor_id];
    most_warnings += stream.takeWarnings().size();
  };
  for (int piece = 0; piece < pieces; ++piece)
  {
    Datagrams datagrams = rig.drive(piece * kTurns, kTurns);
    for (const Datagram& datagram : datagrams)
      for (int block = 0; block < kBlocksOfPacket; ++block)
      {
        const Timestamp stamp = FakeLidar::stampOf(datagram.payload, block);
        sent[datagram.source == OpenRig::senderOf(1)] += stamp >= from && stamp < to;
      }
    for (Datagram& packet : tenSecondsOfStrangers(rig, piece * kTurns, random)) datagrams.push_back(std::move(packet));
    OpenRig::inOrder(datagrams);
    for (const Datagram& datagram : datagrams)
    {
      stream.take(datagram);
      collect();
    }
  }
  stream.finish();
  collect();

  EXPECT_EQ(columns, sent);
  EXPECT_LE(most_warnings, 20u) << "a stranger is told once, not for every packet";
  RecordProperty("blocks", std::to_string(sent[0] + sent[1]));
  RecordProperty("of_other_senders", std::to_string(stream.account().lidars[0].of_other_senders));
}

/** The left lidar's IMU: true samples at 100 Hz bear their number, a flood's have number -1. */
struct ImuOfLidar
{
  explicit ImuOfLidar(const OpenRig& of) : rig(of) {}

  void add(Timestamp received, Timestamp stamp, std::int64_t reading)
  {
    packets.push_back(
        {received, OpenRig::senderOf(0), 0, rig.rig.addresses[0].imu_port, FakeLidar::imuPacket(stamp, reading)});
  }
  void addTrue()
  {
    for (int n = 0; n < 400; ++n) add(kFirst + n * 10ms + 400us, kFirst + n * 10ms, n);
  }

  const OpenRig& rig;
  Datagrams packets;
};

std::vector<double> readingsIn(const Batched& run)
{
  std::vector<double> readings;
  for (const SensorEvent& event : run.events)
    if (const auto* imu = std::get_if<SensorImu>(&event)) readings.push_back(imu->sample.gyro.x());
  return readings;
}

Batched withImu(const OpenRig& rig, const Datagrams& imu)
{
  Datagrams all = rig.drive();
  all.insert(all.begin(), imu.begin(), imu.end());
  OpenRig::inOrder(all);
  return runOf(rig.rig, all);
}

/** From the lidar's own address: only the stamps tell. */
TEST(ImuFlood, ofStampsThatAreNotTheLidarsIsLeftOutCountedAndTold)
{
  const OpenRig rig;
  ImuOfLidar calm(rig), flooded(rig);
  calm.addTrue();
  flooded.addTrue();
  std::uint64_t state = 1;
  for (int n = 0; n < 40'000; ++n)  // 10 kHz of any time since 1970 and, in between, of a year ahead
  {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const Timestamp received = kFirst + 5ms + n * 100us;
    flooded.add(received, n % 2 == 0 ? Timestamp{Duration{static_cast<std::int64_t>(state >> 3)}} : received + kYear,
                -1);
  }

  const std::vector<double> expected = readingsIn(withImu(rig, calm.packets));
  const Batched run = withImu(rig, flooded.packets);

  EXPECT_EQ(expected.size(), 400u);
  EXPECT_EQ(readingsIn(run), expected) << summaryOf(run);
  EXPECT_EQ(run.account.implausible_imu_samples, 40'000u);
  EXPECT_THAT(run.warnings, testing::Contains(testing::HasSubstr("imu_samples_implausible"))) << summaryOf(run);
}

TEST(ImuFlood, beforeItsLidarIsHeardIsBounded)
{
  const OpenRig rig;
  ImuOfLidar flooded(rig);
  for (int n = 0; n < 120'000; ++n) flooded.add(kFirst - 12s + n * 100us, kFirst - 12s + n * 100us, -1);
  const Batched run = withImu(rig, flooded.packets);
  EXPECT_LE(readingsIn(run).size(), ImuOrder::kMostWaiting) << summaryOf(run);
  EXPECT_GT(run.account.input.at("imu_samples_dropped"), 0u);
}

TEST(ImuFlood, aYearAheadBeforeTheLidarIsHeardIsNotGivenOut)
{
  const OpenRig rig;
  ImuOfLidar imu(rig);
  imu.addTrue();
  for (int n = 0; n < 50; ++n) imu.add(kFirst - 100ms + n * 1ms, kFirst - 100ms + n * 1ms + kYear, -1);
  const Batched run = withImu(rig, imu.packets);
  const std::vector<double> readings = readingsIn(run);
  EXPECT_EQ(std::count(readings.begin(), readings.end(), -1), 0) << summaryOf(run);
  EXPECT_GE(readings.size(), 398u) << "one or two came before the lidar's first packet";
}
}  // namespace scanloom::strangers_unittest
