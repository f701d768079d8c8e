#include "input/batching/TimeBatcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "FaultRig.h"
#include "support/with.h"

namespace scanloom::time_batcher_unittest
{
namespace
{
Arrivals arrivalsOf(LidarIndex lidar, const std::vector<std::vector<std::uint8_t>>& packets, Duration delay = kDelay)
{
  Arrivals arrivals;
  addPackets(arrivals, lidar, packets, delay);
  return arrivals;
}

Arrivals inOrderOfArrival(Arrivals a, const Arrivals& b)
{
  a.insert(a.end(), b.begin(), b.end());
  scanloom::inOrderOfArrival(a);
  return a;
}

Arrivals twoLidars(Duration left, Duration right, Duration length)
{
  const FakeLidar lidar;
  return inOrderOfArrival(arrivalsOf(0, lidar.drive(Timestamp{left}, length)),
                          arrivalsOf(1, lidar.drive(Timestamp{right}, length)));
}

/** Only packets tell the time. */
Outcome replayed(const Rig& rig, const Arrivals& arrivals, const BatcherOptions& options = {})
{
  return batch(rig, arrivals, options, Clock::Replay);
}
}  // namespace

TEST(TimeBatcher, startsAtTheNextWholePeriodAfterTheLatestLidarPlusThePhase)
{
  struct Row
  {
    const char* fact;
    Duration right, phase, start;
  };
  for (const Row& row :
       {Row{"between", 70ms, 0ms, 100ms},
        Row{"a first stamp on the grid starts one period later, as equation (1) says", 100ms, 0ms, 200ms},
        Row{"the phase shifts the grid", 70ms, 37ms, 137ms}})
  {
    BatcherOptions options;
    options.scan_phase_ms = 1e3 * seconds(row.phase);
    const auto scans = replayed({{}, {}}, twoLidars(30ms, row.right, 400ms), options).scans;
    EXPECT_EQ(scans.front().start, Timestamp{row.start}) << row.fact;
  }
}

TEST(TimeBatcher, oneTurnOfALidarAloneIsAWholeScanWhereThePhaseIsThatOfItsFirstBlock)
{
  const Outcome outcome = replayed({{}}, arrivalsOf(0, FakeLidar().drive(Timestamp{137ms}, 100ms)),
                                   with(&BatcherOptions::scan_phase_ms, 37));
  ASSERT_EQ(outcome.scans.size(), 1u);
  EXPECT_EQ(outcome.scans[0].columns.size(), 64u);
  EXPECT_EQ(outcome.count(0, &LidarCounters::before_start), 0u);
}

TEST(TimeBatcher, turnsThatAProgramCutAreScansFromTheFirstOneOn)
{
  FakeLidarOptions cloud;
  cloud.columns_per_packet = cloud.columns_per_frame;
  const auto left = FakeLidar(cloud).drive(Timestamp{100ms}, 300ms),
             right = FakeLidar(cloud).drive(Timestamp{100200us}, 300ms);
  const auto scans = replayed({cloud, cloud}, inOrderOfArrival(arrivalsOf(0, left), arrivalsOf(1, right))).scans;
  EXPECT_EQ(scans.front().start, Timestamp{100ms});
  EXPECT_EQ(scans.front().columns.size(), 128u);
}

TEST(TimeBatcher, aBlockAtTheBoundaryOpensTheNextScan)
{
  FakeLidarOptions lidar;
  lidar.columns_per_frame = 100;  // one block per millisecond: stamps on the boundaries
  lidar.columns_per_packet = 10;
  lidar.last_column = 99;
  const auto scans = replayed({lidar}, arrivalsOf(0, FakeLidar(lidar).drive(Timestamp{50ms}, 400ms))).scans;
  ASSERT_GE(scans.size(), 2u);
  EXPECT_EQ(scans[0].columns.front().stamp, Timestamp{100ms});
  EXPECT_EQ(scans[0].columns.back().stamp, Timestamp{199ms});
  EXPECT_EQ(scans[1].columns.front().stamp, Timestamp{200ms});
}

TEST(TimeBatcher, anEmptyPeriodGivesAnEmptyScanSoThatTheRateStaysConstant)
{
  FakeLidarOptions sector;
  sector.last_column = 7;
  BatcherOptions options;
  options.scan_rate = 40;
  const auto scans = replayed({sector}, arrivalsOf(0, FakeLidar(sector).drive(Timestamp{50ms}, 1s)), options).scans;
  EXPECT_TRUE(std::any_of(scans.begin(), scans.end(), [](const Scan& s) { return s.columns.empty(); }));
}

TEST(TimeBatcher, theScanCutByTheEndIsGivenOutAndMarked)
{
  const auto scans = replayed({{}}, arrivalsOf(0, FakeLidar().drive(Timestamp{50ms}, 300ms))).scans;
  EXPECT_FALSE(scans.back().complete());
  EXPECT_TRUE(scans.front().complete());
}

TEST(TimeBatcher, aMalformedPacketIsCountedAndNothingElseIsLost)
{
  auto arrivals = twoLidars(30ms, 70ms, 1s);
  arrivals.insert(arrivals.begin() + 20, {0, {1, 2, 3}, arrivals[20].received, {}});
  const Outcome outcome = replayed({{}, {}}, arrivals);
  EXPECT_EQ(outcome.count(0, &LidarCounters::malformed_packets), 1u);
  EXPECT_EQ(outcome.count(0, &LidarCounters::lost), 0u);
}

TEST(TimeBatcher, aTimeOffsetBringsAClockIntoLine)
{
  TimeBatcher batcher({{"left", std::make_shared<FakeLidar>()}, {"right", std::make_shared<FakeLidar>(), -37s}}, {});
  auto left = arrivalsOf(0, FakeLidar().drive(Timestamp{50ms}, 300ms));
  auto right = arrivalsOf(1, FakeLidar().drive(Timestamp{37s + 50ms}, 300ms), 100us - 37s);
  for (const Arrival& a : inOrderOfArrival(left, right)) push(batcher, a.lidar, a.packet, a.received);
  const Scan last = batcher.finish().back();
  EXPECT_GT(last.columns_of[0], 0u);
  EXPECT_GT(last.columns_of[1], 0u);
}

TEST(TimeBatcher, skipsScansThatNobodyWantsBetweenTwoRecordingsAndKeepsTheGrid)
{
  const FakeLidar lidar;
  Arrivals arrivals = arrivalsOf(0, lidar.drive(Timestamp{100s}, 1s));
  addPackets(arrivals, 0, lidar.drive(Timestamp{100s + 24h * 365 * 40}, 1s));
  TimeBatcher batcher = batcherOf({{}}, {});
  std::vector<Scan> scans;
  for (const Arrival& a : arrivals)
    for (Scan& scan : push(batcher, a.lidar, a.packet, a.received)) scans.push_back(std::move(scan));
  for (Scan& scan : batcher.finish()) scans.push_back(std::move(scan));
  EXPECT_LT(scans.size(), 100u);
  EXPECT_GT(scans.back().start, Timestamp{100s + 24h * 365 * 40});
  EXPECT_EQ((scans.back().start - scans.front().start) % scans.front().period, 0ns);
  Timestamp last = Timestamp::min();
  for (const Scan& scan : scans)
    for (const Column& c : scan.columns) EXPECT_GE(c.stamp, std::exchange(last, c.stamp));
  const LidarCounters& c = batcher.counters(0);
  EXPECT_EQ(c.emitted + c.before_start + c.late, c.received);
}
}  // namespace scanloom::time_batcher_unittest
