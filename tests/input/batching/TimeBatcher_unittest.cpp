#include "input/batching/TimeBatcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/FakeLidar.h"
#include "support/pushPacket.h"

namespace scanloom::time_batcher_unittest
{
namespace
{
struct Arrival
{
  LidarIndex lidar = 0;
  std::vector<std::uint8_t> packet;
  Timestamp received;
};

Timestamp lastStampOf(const std::vector<std::uint8_t>& packet)
{
  return fromNanoseconds(load<std::int64_t>(packet, packet.size() - FakeLidar::kBlockSize));
}

std::vector<Arrival> arrivalsOf(LidarIndex lidar, const std::vector<std::vector<std::uint8_t>>& packets,
                                Duration delay = 100us)
{
  std::vector<Arrival> arrivals;
  for (const auto& packet : packets) arrivals.push_back({lidar, packet, lastStampOf(packet) + delay});
  return arrivals;
}

std::vector<Arrival> inOrderOfArrival(std::vector<Arrival> a, const std::vector<Arrival>& b)
{
  a.insert(a.end(), b.begin(), b.end());
  std::stable_sort(a.begin(), a.end(), [](const Arrival& l, const Arrival& r) { return l.received < r.received; });
  return a;
}

TimeBatcher fakeLidars(const std::vector<FakeLidarOptions>& lidars, const BatcherOptions& options = {})
{
  std::vector<BatchedLidar> inputs;
  for (const auto& lidar : lidars)
    inputs.push_back({"lidar" + std::to_string(inputs.size() + 1), std::make_shared<FakeLidar>(lidar)});
  return {inputs, options};
}

std::vector<Scan> feed(TimeBatcher& batcher, const std::vector<Arrival>& arrivals)
{
  std::vector<Scan> scans;
  const auto collect = [&scans](std::vector<Scan> more)
  { std::move(more.begin(), more.end(), std::back_inserter(scans)); };
  for (const Arrival& arrival : arrivals) collect(push(batcher, arrival.lidar, arrival.packet, arrival.received));
  collect(batcher.finish());
  return scans;
}

std::vector<Arrival> twoLidars(Duration left, Duration right, Duration length)
{
  const FakeLidar lidar;
  return inOrderOfArrival(arrivalsOf(0, lidar.drive(Timestamp{left}, length)),
                          arrivalsOf(1, lidar.drive(Timestamp{right}, length)));
}

void expectTimeOrder(const std::vector<Scan>& scans)
{
  Timestamp previous = Timestamp::min();
  for (const Scan& scan : scans)
    for (const Column& column : scan.columns)
    {
      EXPECT_GE(column.stamp, previous);
      EXPECT_GE(column.stamp, scan.start);
      EXPECT_LT(column.stamp, scan.end());
      previous = column.stamp;
    }
}

void expectAccountsAreClosed(const LidarCounters& c)
{
  EXPECT_EQ(c.received,
            c.emitted + c.late + c.duplicate + c.invalid + c.before_start + c.implausible + c.quarantined + c.dropped);
}
}  // namespace

TEST(TimeBatcher, startsAtTheNextWholePeriodAfterTheLatestLidar)
{
  TimeBatcher batcher = fakeLidars({{}, {}});
  const auto scans = feed(batcher, twoLidars(30ms, 70ms, 300ms));
  EXPECT_EQ(scans.front().start, Timestamp{100ms});
}

TEST(TimeBatcher, aFirstStampOnTheGridStartsOnePeriodLaterAsEquationOneSays)
{
  TimeBatcher batcher = fakeLidars({{}, {}});
  const auto scans = feed(batcher, twoLidars(30ms, 100ms, 400ms));
  EXPECT_EQ(scans.front().start, Timestamp{200ms});
}

TEST(TimeBatcher, thePhaseShiftsTheGrid)
{
  BatcherOptions options;
  options.scan_phase_ms = 37;
  TimeBatcher batcher = fakeLidars({{}, {}}, options);
  EXPECT_EQ(feed(batcher, twoLidars(30ms, 70ms, 300ms)).front().start, Timestamp{137ms});
}

TEST(TimeBatcher, oneTurnOfALidarAloneIsAWholeScanWhereThePhaseIsThatOfItsFirstBlock)
{
  BatcherOptions options;
  options.scan_phase_ms = 37;
  TimeBatcher batcher = fakeLidars({{}}, options);
  const auto scans = feed(batcher, arrivalsOf(0, FakeLidar().drive(Timestamp{137ms}, 100ms)));
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_EQ(scans[0].columns.size(), 64u);
  EXPECT_EQ(batcher.counters(0).before_start, 0u);
}

TEST(TimeBatcher, turnsThatAProgramCutAreScansFromTheFirstOneOn)
{
  FakeLidarOptions cloud;
  cloud.columns_per_packet = cloud.columns_per_frame;
  TimeBatcher batcher = fakeLidars({cloud, cloud});
  const auto left = FakeLidar(cloud).drive(Timestamp{100ms}, 300ms),
             right = FakeLidar(cloud).drive(Timestamp{100200us}, 300ms);
  const auto scans = feed(batcher, inOrderOfArrival(arrivalsOf(0, left), arrivalsOf(1, right)));
  EXPECT_EQ(scans.front().start, Timestamp{100ms});
  EXPECT_EQ(scans.front().columns.size(), 128u);
}

TEST(TimeBatcher, columnsNeverGoBackInTimeWithinAndAcrossScans)
{
  TimeBatcher batcher = fakeLidars({{}, {}});
  expectTimeOrder(feed(batcher, twoLidars(30ms, 71ms, 1s)));
}

TEST(TimeBatcher, aBlockAtTheBoundaryOpensTheNextScan)
{
  FakeLidarOptions lidar;
  lidar.columns_per_frame = 100;  // one block per millisecond: stamps on the boundaries
  lidar.columns_per_packet = 10;
  lidar.last_column = 99;
  TimeBatcher batcher = fakeLidars({lidar});
  const auto scans = feed(batcher, arrivalsOf(0, FakeLidar(lidar).drive(Timestamp{50ms}, 400ms)));
  ASSERT_GE(scans.size(), 2u);
  EXPECT_EQ(scans[0].columns.front().stamp, Timestamp{100ms});
  EXPECT_EQ(scans[0].columns.back().stamp, Timestamp{199ms});
  EXPECT_EQ(scans[1].columns.front().stamp, Timestamp{200ms});
}

TEST(TimeBatcher, everyBlockAfterTheStartIsEmittedOnce)
{
  TimeBatcher batcher = fakeLidars({{}, {}});
  const auto scans = feed(batcher, twoLidars(30ms, 70ms, 1s));
  std::size_t columns = 0;
  for (const Scan& scan : scans) columns += scan.columns.size();
  EXPECT_EQ(columns, batcher.counters(0).emitted + batcher.counters(1).emitted);
  for (LidarIndex i : {0, 1})
  {
    expectAccountsAreClosed(batcher.counters(i));
    EXPECT_EQ(batcher.counters(i).received, batcher.counters(i).emitted + batcher.counters(i).before_start);
    EXPECT_EQ(batcher.counters(i).lost, 0u);
  }
}

TEST(TimeBatcher, equalStampsAreOrderedBySensor)
{
  TimeBatcher batcher = fakeLidars({{}, {}});
  const auto scans = feed(batcher, twoLidars(50ms, 50ms, 300ms));
  const auto& columns = scans.front().columns;
  for (std::size_t i = 0; i + 1 < columns.size(); i += 2)
  {
    EXPECT_EQ(columns[i].stamp, columns[i + 1].stamp);
    EXPECT_LT(columns[i].sensor_id, columns[i + 1].sensor_id);
  }
}

TEST(TimeBatcher, aSilentLidarHoldsNobodyLongerThanTheDeadline)
{
  const FakeLidar lidar;
  auto left = arrivalsOf(0, lidar.drive(Timestamp{50ms}, 2s));
  auto right = arrivalsOf(1, lidar.drive(Timestamp{50ms}, 500ms));  // falls silent
  TimeBatcher batcher = fakeLidars({{}, {}});
  std::vector<std::pair<Timestamp, Scan>> released;
  Timestamp now{50ms};
  for (const Arrival& a : inOrderOfArrival(left, right))
  {
    for (; now < a.received; now += 500us)
      for (Scan& scan : batcher.advance(now)) released.emplace_back(now, std::move(scan));
    for (Scan& scan : push(batcher, a.lidar, a.packet, a.received)) released.emplace_back(a.received, std::move(scan));
  }
  ASSERT_EQ(released.size(), 19u);
  const Duration packet = lidar.description().blockPeriod() * 8;
  for (const auto& [when, scan] : released)
  {
    EXPECT_LE(when - scan.end(), 5ms + packet + 1ms);
    EXPECT_EQ(scan.complete(), scan.end() <= Timestamp{500ms}) << nanoseconds(scan.start);
    EXPECT_EQ(scan.columns_of[1] == 0, scan.start >= Timestamp{550ms});
  }
}

TEST(TimeBatcher, aLidarThatNeverStartsDelaysTheFirstScanByNoMoreThanTwoPeriodsAndTheDeadline)
{
  const FakeLidar lidar;
  TimeBatcher batcher = fakeLidars({{}, {}});
  std::optional<Timestamp> first;
  for (const Arrival& a : arrivalsOf(0, lidar.drive(Timestamp{130ms}, 1s)))
    if (!push(batcher, a.lidar, a.packet, a.received).empty() && !first) first = a.received;
  ASSERT_TRUE(first);
  EXPECT_LE(*first - Timestamp{130ms}, 2 * 100ms + 5ms + 13ms);
}

TEST(TimeBatcher, anAzimuthWindowCausesNoMissedDeadline)
{
  FakeLidarOptions windowed;
  windowed.first_column = 16;
  windowed.last_column = 31;
  const FakeLidar full, quarter(windowed);
  TimeBatcher batcher = fakeLidars({{}, windowed});
  const auto arrivals = inOrderOfArrival(arrivalsOf(0, full.drive(Timestamp{50ms}, 1s)),
                                         arrivalsOf(1, quarter.drive(Timestamp{63ms}, 1s)));
  const auto scans = feed(batcher, arrivals);
  for (std::size_t i = 0; i + 1 < scans.size(); ++i) EXPECT_TRUE(scans[i].complete());
  EXPECT_EQ(batcher.counters(1).late, 0u);
  EXPECT_EQ(batcher.counters(1).lost, 0u);
}

TEST(TimeBatcher, countsEachLostPacketExactly)
{
  const FakeLidar lidar;
  auto arrivals = twoLidars(30ms, 70ms, 1s);
  arrivals.erase(arrivals.begin() + 40, arrivals.begin() + 43);
  arrivals.erase(arrivals.begin() + 70);
  TimeBatcher batcher = fakeLidars({{}, {}});
  expectTimeOrder(feed(batcher, arrivals));
  EXPECT_EQ(batcher.counters(0).lost + batcher.counters(1).lost, 4u * 8u);
  for (LidarIndex i : {0, 1})
  {
    expectAccountsAreClosed(batcher.counters(i));
    EXPECT_EQ(batcher.counters(i).sent(), 80u * 8u);
    EXPECT_EQ(batcher.counters(i).late, 0u);
  }
}

TEST(TimeBatcher, duplicatesAppearOnce)
{
  auto arrivals = twoLidars(30ms, 70ms, 1s);
  const auto once = arrivals;
  for (std::size_t i = 0; i < once.size(); i += 10)
    arrivals.push_back({once[i].lidar, once[i].packet, once[i].received + 1ms});
  TimeBatcher clean = fakeLidars({{}, {}}), batcher = fakeLidars({{}, {}});
  const auto expected = feed(clean, once);
  const auto scans = feed(batcher, inOrderOfArrival(arrivals, {}));
  EXPECT_EQ(batcher.counters(0).emitted, clean.counters(0).emitted);
  EXPECT_EQ(batcher.counters(0).duplicate + batcher.counters(1).duplicate, 16u * 8u);
  EXPECT_EQ(scans.size(), expected.size());
}

TEST(TimeBatcher, frameIdsMayWrapAround)
{
  const FakeLidar lidar;
  TimeBatcher batcher = fakeLidars({{}});
  feed(batcher, arrivalsOf(0, lidar.drive(Timestamp{50ms}, 2s, 65530)));
  EXPECT_EQ(batcher.counters(0).lost, 0u);
  EXPECT_EQ(batcher.counters(0).restarts, 0u);
  EXPECT_EQ(batcher.counters(0).late, 0u);
}

TEST(TimeBatcher, anEmptyPeriodGivesAnEmptyScanSoThatTheRateStaysConstant)
{
  FakeLidarOptions sector;
  sector.last_column = 7;
  const FakeLidar lidar(sector);
  BatcherOptions options;
  options.scan_rate = 40;
  TimeBatcher batcher = fakeLidars({sector}, options);
  const auto scans = feed(batcher, arrivalsOf(0, lidar.drive(Timestamp{50ms}, 1s)));
  EXPECT_TRUE(std::any_of(scans.begin(), scans.end(), [](const Scan& s) { return s.columns.empty(); }));
  for (std::size_t i = 1; i < scans.size(); ++i) EXPECT_EQ(scans[i].start, scans[i - 1].end());
}

TEST(TimeBatcher, theScanCutByTheEndIsGivenOutAndMarked)
{
  TimeBatcher batcher = fakeLidars({{}});
  const auto scans = feed(batcher, arrivalsOf(0, FakeLidar().drive(Timestamp{50ms}, 300ms)));
  EXPECT_FALSE(scans.back().complete());
  EXPECT_TRUE(scans.front().complete());
}

TEST(TimeBatcher, aMalformedPacketIsCountedAndNothingElseIsLost)
{
  auto arrivals = twoLidars(30ms, 70ms, 1s);
  arrivals.insert(arrivals.begin() + 20, {0, {1, 2, 3}, arrivals[20].received});
  TimeBatcher batcher = fakeLidars({{}, {}});
  feed(batcher, arrivals);
  EXPECT_EQ(batcher.counters(0).malformed_packets, 1u);
  EXPECT_EQ(batcher.counters(0).lost, 0u);
}

TEST(TimeBatcher, clocksThatDisagreeAreRefusedWithTheOffsetWhereTheConfigurationSaysSo)
{
  BatcherOptions options;
  options.other_clock = "refuse";
  TimeBatcher batcher = fakeLidars({{}, {}}, options);
  auto left = arrivalsOf(0, FakeLidar().drive(Timestamp{50ms}, 300ms));
  auto right = arrivalsOf(1, FakeLidar().drive(Timestamp{37s + 50ms}, 300ms), 100us - 37s);
  EXPECT_THROW(feed(batcher, inOrderOfArrival(left, right)), std::runtime_error);
}

TEST(TimeBatcher, aTimeOffsetBringsAClockIntoLine)
{
  TimeBatcher batcher({{"left", std::make_shared<FakeLidar>()}, {"right", std::make_shared<FakeLidar>(), -37s}}, {});
  auto left = arrivalsOf(0, FakeLidar().drive(Timestamp{50ms}, 300ms));
  auto right = arrivalsOf(1, FakeLidar().drive(Timestamp{37s + 50ms}, 300ms), 100us - 37s);
  const auto scans = feed(batcher, inOrderOfArrival(left, right));
  EXPECT_GT(scans.front().columns_of[0], 0u);
  EXPECT_GT(scans.front().columns_of[1], 0u);
}

TEST(TimeBatcher, skipsScansThatNobodyWantsBetweenTwoRecordingsAndKeepsTheGrid)
{
  const FakeLidar lidar;
  TimeBatcher batcher = fakeLidars({{}});
  std::vector<Arrival> arrivals = arrivalsOf(0, lidar.drive(Timestamp{100s}, 1s));
  const std::vector<Arrival> later = arrivalsOf(0, lidar.drive(Timestamp{100s + 24h * 365 * 40}, 1s));
  arrivals.insert(arrivals.end(), later.begin(), later.end());
  const std::vector<Scan> scans = feed(batcher, arrivals);

  EXPECT_LT(scans.size(), 100u);
  EXPECT_GT(scans.back().start, Timestamp{100s + 24h * 365 * 40});
  EXPECT_EQ((scans.back().start - scans.front().start) % scans.front().period, 0ns);
  expectTimeOrder(scans);
  EXPECT_EQ(batcher.counters(0).emitted + batcher.counters(0).before_start + batcher.counters(0).late,
            batcher.counters(0).received);
}
}  // namespace scanloom::time_batcher_unittest
