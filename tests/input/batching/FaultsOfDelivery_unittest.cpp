// F1 to F6, F15, F16, F24 of the fault table: what networks do to packets.
#include <gtest/gtest.h>

#include <map>

#include "FaultRig.h"

namespace scanloom::faults_of_delivery_unittest
{
namespace
{
constexpr auto kLost = &LidarCounters::lost;
constexpr auto kLate = &LidarCounters::late;

/** Scans come at their rate, and none later than the deadline allows. */
void expectConstantRate(const Outcome& outcome)
{
  EXPECT_LE(latestRelease(outcome), 1e3 * seconds(kDeadline + kPacketTime + 1ms));
  measured("latest_release_ms", latestRelease(outcome));
}

/** Blocks of the packets of `sent` that did not arrive, between the first and the last that did. */
std::uint64_t blocksLost(const Arrivals& sent, const Arrivals& arrived, LidarIndex lidar, std::size_t per_packet)
{
  Timestamp first = Timestamp::max(), last = Timestamp::min();
  std::size_t count = 0, of = 0;
  for (const Arrival& a : arrived)
  {
    if (a.lidar != lidar) continue;
    first = std::min(first, a.sent);
    last = std::max(last, a.sent);
    ++count;
  }
  for (const Arrival& a : sent) of += a.lidar == lidar && a.sent >= first && a.sent <= last;
  return (of - count) * per_packet;
}

void expectExactLoss(const Outcome& outcome, const Rig& rig, const Arrivals& sent, const Arrivals& arrived)
{
  for (LidarIndex i = 0; i < rig.size(); ++i)
  {
    EXPECT_EQ(outcome.count(i, kLost), blocksLost(sent, arrived, i, blocksPerPacket(rig[i]))) << "lidar " << i;
    EXPECT_EQ(outcome.counters[i].sent(), outcome.count(i, kLost) + outcome.count(i, &LidarCounters::received));
  }
}

void expectNothingLate(const Outcome& outcome)
{
  for (const LidarCounters& c : outcome.counters)
    EXPECT_EQ(c.late + c.dropped + c.implausible + c.doubtful_packets, 0u);
}
}  // namespace

using F1Silence = testing::TestWithParam<Duration>;

TEST_P(F1Silence, ofAnyLidarsStopsNobodyAndEndsWithTheFirstPacket)
{
  const Duration silence = GetParam();
  const Rig rig = referenceRig();
  const Timestamp from = kBegin + 450ms, until = from + silence;
  const Arrivals sent = drive(rig, silence + 1s);
  for (unsigned silent = 1; silent + 1 < 1u << rig.size(); silent += silence > 10s ? 5 : 1)
  {
    Arrivals arrived = sent;
    removeIf(arrived, [&](const Arrival& a) { return (silent >> a.lidar & 1) && a.sent >= from && a.sent < until; });
    const Outcome outcome = batch(rig, arrived);

    expectConstantRate(outcome);
    expectExactLoss(outcome, rig, sent, arrived);
    expectNothingLate(outcome);
    for (const Scan& scan : outcome.scans)
      for (LidarIndex i = 0; i < rig.size(); ++i)
      {
        const bool gone = (silent >> i & 1) && scan.end() > from + 2ms && scan.end() < until - 2ms;
        const bool last = scan.start == outcome.scans.back().start;
        EXPECT_TRUE(last || scan.missing.test(i) == gone) << i << " at " << seconds(scan.end() - kBegin);
        if (scan.start < until && scan.end() > until + 4ms)
        {
          EXPECT_GT(scan.columns_of[i], 0u);
        }
      }
  }
}
INSTANTIATE_TEST_SUITE_P(All, F1Silence, testing::Values(Duration{50ms}, Duration{1s}, Duration{60s}), nameOfDuration);

TEST(F1, silenceAndReturnAreNoticedOnceWithTheirLength)
{
  const Rig rig = referenceRig();
  Arrivals arrived = drive(rig, 3s);
  removeIf(arrived, [&](const Arrival& a) { return a.lidar == 1 && a.sent >= kBegin + 1s && a.sent < kBegin + 2s; });
  const Outcome outcome = batch(rig, arrived);
  ASSERT_EQ(outcome.of(Notice::Kind::Silent).size(), 1u);
  ASSERT_EQ(outcome.of(Notice::Kind::Back).size(), 1u);
  EXPECT_EQ(outcome.of(Notice::Kind::Back).front().lidar, 1u);
  EXPECT_NEAR(seconds(outcome.of(Notice::Kind::Back).front().duration), 1.0, 0.005);
  EXPECT_EQ(outcome.count(1, &LidarCounters::missed_scans), 10u);
}

TEST(F2, anAzimuthWindowMissesNoDeadlineAndAddsNoLatency)
{
  Rig rig = referenceRig();
  rig[1].first_column = 128;
  rig[1].last_column = 383;  // 90 degrees
  const Arrivals arrivals = drive(rig, 5s);
  const Outcome outcome = batch(rig, arrivals);
  for (LidarIndex i = 0; i < rig.size(); ++i) EXPECT_EQ(outcome.count(i, &LidarCounters::missed_scans), 0u);
  for (std::size_t k = 0; k + 1 < outcome.scans.size(); ++k) EXPECT_TRUE(outcome.scans[k].complete());
  expectExactLoss(outcome, rig, arrivals, arrivals);
  expectNothingLate(outcome);
  EXPECT_LE(latestRelease(outcome), 1e3 * seconds(kPacketTime + 1ms));
  measured("latest_release_ms", latestRelease(outcome));
}

TEST(F3, aLidarThatNeverStartsDelaysTheFirstFullScanByTwoPeriodsAndTheDeadlineAtMost)
{
  const Rig rig = referenceRig();
  for (unsigned dead = 1; dead + 1 < 1u << rig.size(); ++dead)
  {
    Arrivals arrivals = drive(rig, 1s);
    removeIf(arrivals, [&](const Arrival& a) { return (dead >> a.lidar & 1) != 0; });
    const Outcome outcome = batch(rig, arrivals);
    const Duration waited = outcome.released.front() - arrivals.front().received;
    EXPECT_LE(waited, 2 * kPeriod + kDeadline + kPacketTime) << dead;
    measured("first_scan_after_ms_" + std::to_string(dead), 1e3 * seconds(waited));
  }
}

TEST(F3, aLidarThatStartsLaterJoinsWithItsFirstPacket)
{
  const Rig rig = referenceRig();
  Arrivals arrivals = drive(rig, 2s);
  removeIf(arrivals, [&](const Arrival& a) { return a.lidar == 2 && a.sent < kBegin + 1s; });
  const Outcome outcome = batch(rig, arrivals);
  EXPECT_EQ(outcome.count(2, kLate) + outcome.count(2, &LidarCounters::before_start), 0u);
  EXPECT_EQ(outcome.offsets[2], Duration{0});
}

TEST(F4, lossIsCountedExactlyAndEverythingElseIsEmitted)
{
  const Rig rig = referenceRig();
  const Arrivals sent = drive(rig, 4s);
  for (const double share : {0.001, 0.01, 0.05, 0.2})
  {
    std::mt19937 random(4);  // NOLINT
    std::bernoulli_distribution lost(share);
    Arrivals arrived = sent;
    removeIf(arrived, [&](const Arrival&) { return lost(random); });
    const Outcome outcome = batch(rig, arrived);
    expectExactLoss(outcome, rig, sent, arrived);
    expectNothingLate(outcome);
    expectConstantRate(outcome);
  }
}

TEST(F4, burstsOfUpTo64PacketsAreCountedExactly)
{
  const Rig rig = referenceRig();
  const Arrivals sent = drive(rig, 4s);
  for (int length = 1; length <= 64; length += 7)
  {
    std::map<LidarIndex, int> seen;
    Arrivals arrived = sent;
    removeIf(arrived, [&](const Arrival& a) { return seen[a.lidar]++ % 500 >= 500 - length; });
    const Outcome outcome = batch(rig, arrived);
    expectExactLoss(outcome, rig, sent, arrived);
    expectNothingLate(outcome);
    expectConstantRate(outcome);
  }
}

namespace
{
/** Every 40th packet of lidar 0 comes after `depth` of its successors. */
Arrivals reordered(const Rig& rig, int depth)
{
  Arrivals arrivals = drive(rig, 3s);
  int n = 0;
  for (Arrival& a : arrivals)
    if (a.lidar == 0 && ++n % 40 == 0) a.received += depth * kPacketTime;
  inOrderOfArrival(arrivals);
  return arrivals;
}
}  // namespace

TEST(F5, reorderingWithinTheDeadlineLosesNothing)
{
  const Rig rig = referenceRig();
  const std::string in_order = digestOf(batch(rig, reordered(rig, 0)).scans);
  for (int depth = 1; depth <= 3; ++depth)
  {
    const Outcome outcome = batch(rig, reordered(rig, depth));
    expectNothingLate(outcome);
    EXPECT_EQ(outcome.count(0, kLost), 0u);
    EXPECT_EQ(digestOf(outcome.scans), in_order);
  }
}

TEST(F5, whatIsDisplacedFurtherIsCountedLateOrRecoveredAndTheOrderHolds)
{
  const Rig rig = referenceRig();
  const Outcome outcome = batch(rig, reordered(rig, 8));
  const std::uint64_t displaced = 1920 / 40 * 16;
  EXPECT_EQ(outcome.count(0, kLost), 0u);
  EXPECT_LE(outcome.count(0, kLate), displaced);
  EXPECT_GE(outcome.count(0, kLate), displaced - 32);  // those before the start are not late
  measured("late_blocks_of_displaced_768", static_cast<double>(outcome.count(0, kLate)));
}

TEST(F6, everyBlockComesOnceUnderDuplicates)
{
  const Rig rig = referenceRig();
  const Arrivals sent = drive(rig, 3s);
  const std::string once = digestOf(batch(rig, sent).scans);

  Arrivals twice = sent;
  for (std::size_t i = 0; i < sent.size(); i += 10)
  {
    twice.push_back(sent[i]);
    twice.back().received += 1ms;
  }
  for (const Arrival& a : sent)  // and a whole turn of everybody again
    if (a.sent >= kBegin + 1s && a.sent < kBegin + 1100ms)
    {
      twice.push_back(a);
      twice.back().received += 30ms;
    }
  inOrderOfArrival(twice);
  const Outcome outcome = batch(rig, twice);
  EXPECT_EQ(digestOf(outcome.scans), once);
  expectNothingLate(outcome);
  for (LidarIndex i = 0; i < rig.size(); ++i)
  {
    const auto packetsIn = [i](const Arrivals& arrivals)
    { return std::count_if(arrivals.begin(), arrivals.end(), [i](const Arrival& a) { return a.lidar == i; }); };
    const auto added = static_cast<std::size_t>(packetsIn(twice) - packetsIn(sent));
    EXPECT_EQ(outcome.count(i, &LidarCounters::duplicate), added * blocksPerPacket(rig[i]));
  }
}

TEST(F15, equalStampsOfAllSensorsComeInADefinedOrderEveryTime)
{
  const Rig rig{ouster(10), ouster(10), ouster(10)};
  Arrivals arrivals;
  for (LidarIndex i = 0; i < rig.size(); ++i) addPackets(arrivals, i, FakeLidar(rig[i]).drive(kBegin, 500ms));
  inOrderOfArrival(arrivals);
  const std::string first = digestOf(batch(rig, arrivals).scans);
  std::mt19937 random(15);  // NOLINT
  for (int run = 0; run < 100; ++run)
  {
    for (Arrival& a : arrivals) a.received = a.sent + kDelay + Duration{random() % 1000000};
    Arrivals shuffled = arrivals;
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    inOrderOfArrival(shuffled);
    ASSERT_EQ(digestOf(batch(rig, shuffled).scans), first);
  }
}

TEST(F16, noInterleavingWithinTheDeadlineChangesABit)
{
  const Rig rig = referenceRig();
  const Arrivals sent = drive(rig, 1s);
  const std::string first = digestOf(batch(rig, sent).scans);
  std::mt19937 random(16);  // NOLINT
  for (int run = 0; run < 30; ++run)
  {
    Arrivals permuted = sent;
    for (Arrival& a : permuted) a.received = a.sent + kDelay + Duration{random() % 4500000};
    inOrderOfArrival(permuted);
    ASSERT_EQ(digestOf(batch(rig, permuted).scans), first);
    ASSERT_EQ(digestOf(batch(rig, permuted, {}, Clock::Replay).scans), first);
  }
}

TEST(F24, afterThreeSecondsWithoutNetworkEverybodyIsBackAtOnceAndTheLossIsExact)
{
  const Rig rig = referenceRig();
  const Arrivals sent = drive(rig, 6s);
  Arrivals arrived = sent;
  const Timestamp down = kBegin + 1500ms, up = down + 3s;
  removeIf(arrived, [&](const Arrival& a) { return a.sent >= down && a.sent < up; });
  const Outcome outcome = batch(rig, arrived);
  expectExactLoss(outcome, rig, sent, arrived);
  expectNothingLate(outcome);
  expectConstantRate(outcome);
  const auto back = outcome.of(Notice::Kind::Back);
  ASSERT_EQ(back.size(), rig.size());
  measured("back_after_ms", 1e3 * seconds(back.back().when - up));
  for (const LidarCounters& c : outcome.counters) EXPECT_EQ(c.restarts, 0u);
}
}  // namespace scanloom::faults_of_delivery_unittest
