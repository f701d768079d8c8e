// F12 to F14 and F23 of the fault table: what clocks do.
#include <gtest/gtest.h>

#include "FaultRig.h"
#include "support/messageOf.h"

namespace scanloom::faults_of_clocks_unittest
{
namespace
{
/** From true time `from` on the lidar's clock is `by` ahead. */
Arrivals stepped(Arrivals arrivals, LidarIndex lidar, Timestamp from, Duration by)
{
  for (Arrival& a : arrivals)
    if (a.lidar == lidar && a.sent >= from) shiftStamps(a.packet, by);
  return arrivals;
}

/** The lidar's points bear the stamp that it wrote; the columns, the common clock's: the largest error against truth.
 */
double largestClockError(const Outcome& outcome, LidarIndex lidar, const std::function<Duration(Timestamp)>& ahead,
                         Timestamp since = Timestamp::min())
{
  double largest = 0;
  for (const Scan& scan : outcome.scans)
    for (const Column& c : scan.columns)
    {
      if (c.sensor_id != lidar || c.stamp < since) continue;
      // FakeLidar writes milliseconds modulo 1 s of the packet's own stamp into x.
      const double written = scan.points.x[c.first_point];
      const double expected = 1e3 * std::fmod(seconds((c.stamp + ahead(c.stamp)).time_since_epoch()), 1.0);
      double error = std::fmod(written - expected + 1500.0, 1000.0) - 500.0;
      largest = std::max(largest, 1e-3 * std::abs(error));
    }
  return largest;
}

std::string others(const Outcome& outcome, LidarIndex lidar)
{
  return digestOf(outcome.scans, [lidar](std::uint8_t id) { return id != lidar; });
}
}  // namespace

using F12Step = testing::TestWithParam<Duration>;

TEST_P(F12Step, ofOneClockIsSeenAtThePacketAfterAndCostsNobodyElseABlock)
{
  const Duration step = GetParam();
  const Rig rig = referenceRig();
  const Arrivals clean = drive(rig, 3s);
  const Timestamp from = kBegin + 1500ms;
  for (LidarIndex lidar = 0; lidar < rig.size(); ++lidar)
  {
    if (rig[lidar].numbering == Numbering::Stamps && step < 1s && step > -1s) continue;  // below what arrival can tell
    const Outcome outcome = batch(rig, stepped(clean, lidar, from, step));

    EXPECT_EQ(others(outcome, lidar), others(batch(rig, clean), lidar));
    const auto noticed = outcome.of(Notice::Kind::ClockStepped);
    ASSERT_EQ(noticed.size(), 1u);
    EXPECT_LE(noticed.front().when - from, 3 * kPacketTime + 1ms);
    const bool by_ids = rig[lidar].numbering == Numbering::Ids;
    EXPECT_NEAR(seconds(noticed.front().duration), seconds(step), by_ids ? 2e-6 : 2e-3);
    EXPECT_EQ(outcome.count(lidar, &LidarCounters::doubtful_packets), 1u);
    EXPECT_EQ(outcome.count(lidar, &LidarCounters::late), 0u);
    const double error = largestClockError(
        outcome, lidar, [&](Timestamp t) { return t > from - 1ms ? step : Duration{0}; }, from + 5ms);
    EXPECT_LT(error, by_ids ? 2e-5 : 2e-3);
    const std::string which = "_lidar" + std::to_string(lidar + 1);
    measured("seen_after_ms" + which, 1e3 * seconds(noticed.front().when - from));
    measured("clock_error_us" + which, 1e6 * error);
  }
}
INSTANTIATE_TEST_SUITE_P(All, F12Step,
                         testing::Values(Duration{37s}, Duration{-37s}, Duration{1s}, Duration{-1s}, Duration{5ms},
                                         Duration{-5ms}),
                         nameOfDuration);

TEST(F12, ptpThatLocksAfterTheStartBringsTheClocksTogether)
{
  // Both boot with clocks of their own; one second later PTP sets them, not at the same moment.
  const Rig rig{ouster(10), ouster(10)};
  const Timestamp lock0 = kBegin + 1s, lock1 = kBegin + 1200ms;
  Arrivals arrivals = drive(rig, 3s);
  const auto ahead = [&](LidarIndex lidar, Timestamp t) -> Duration
  {
    if (t >= (lidar == 0 ? lock0 : lock1)) return Duration{0};
    return lidar == 0 ? Duration{-900s} : Duration{-950s};
  };
  for (Arrival& a : arrivals) shiftStamps(a.packet, ahead(a.lidar, a.sent));
  const Outcome outcome = batch(rig, arrivals);
  EXPECT_EQ(outcome.of(Notice::Kind::ClockStepped).size(), 2u);
  // Whatever common clock results: the two agree in true time, before and after.
  const Duration base0 = outcome.offsets[0], base1 = outcome.offsets[1];
  EXPECT_LT(std::abs(seconds(base0 - base1)), 1e-3);
  for (LidarIndex i : {0, 1}) EXPECT_EQ(outcome.count(i, &LidarCounters::late), 0u);
  for (const Scan& scan : outcome.scans)
    if (&scan != &outcome.scans.back())
    {
      EXPECT_TRUE(scan.columns_of[0] > 900 && scan.columns_of[1] > 900);
    }
}

TEST(F12, aStepIsQuarantinedWhereTheConfigurationSaysSoAndEndsWithTheStepBack)
{
  const Rig rig = referenceRig();
  const Arrivals clean = drive(rig, 3s);
  Arrivals arrivals = stepped(stepped(clean, 1, kBegin + 1s, 37s), 1, kBegin + 2s, -37s);
  const Outcome outcome = batch(rig, arrivals, withOtherClock("quarantine"));
  EXPECT_EQ(outcome.of(Notice::Kind::Quarantined).size(), 1u);
  EXPECT_EQ(others(outcome, 1), others(batch(rig, clean), 1));
  EXPECT_GT(outcome.count(1, &LidarCounters::quarantined), 9800u);
  EXPECT_LE(outcome.count(1, &LidarCounters::quarantined), 10240u);
  EXPECT_GT(outcome.scans[outcome.scans.size() - 2].columns_of[1], 1000u);
}

namespace
{
/** Two lidars of few packets, an hour long; the second one's clock runs `ppm` fast and starts `ahead`. */
Outcome anHour(double ppm, Duration ahead, Rig& rig)
{
  FakeLidarOptions lidar;  // 20 packets a second
  lidar.columns_per_frame = 16;
  lidar.last_column = 15;
  rig.assign(2, lidar);
  Arrivals arrivals = drive(rig, 3600s);
  for (Arrival& a : arrivals)
  {
    if (a.lidar != 1) continue;
    eachBlock(a.packet,
              [&](std::size_t at)
              {
                const auto stamp = load<std::int64_t>(a.packet, at);
                const double drift = 1e-6 * ppm * static_cast<double>(stamp - nanoseconds(kBegin));
                store<std::int64_t>(a.packet, at, stamp + ahead.count() + static_cast<std::int64_t>(drift));
              });
  }
  return batch(rig, arrivals, {}, Clock::Replay);
}
}  // namespace

TEST(F13, driftOfAClockThoughtCommonRaisesAnAlarmEveryFiveMilliseconds)
{
  for (const double ppm : {50.0, -50.0})
  {
    Rig rig;
    const Outcome outcome = anHour(ppm, Duration{0}, rig);
    const auto alarms = outcome.of(Notice::Kind::ClockDrifts);
    ASSERT_GE(alarms.size(), 30u);  // 180 ms
    EXPECT_NEAR(seconds(alarms.front().when - kBegin), 100, 15);
    measured(ppm > 0 ? "first_alarm_s_fast" : "first_alarm_s_slow", seconds(alarms.front().when - kBegin));
    EXPECT_EQ(outcome.count(1, &LidarCounters::lost) + outcome.count(1, &LidarCounters::doubtful_packets), 0u);
    EXPECT_EQ(outcome.count(1, &LidarCounters::late), 0u);
  }
}

TEST(F13, anAlignedClockThatDriftsIsFollowedToAMillisecond)
{
  for (const double ppm : {50.0, -50.0})
  {
    Rig rig;
    const Outcome outcome = anHour(ppm, -900s, rig);
    const auto ahead = [&](Timestamp t) { return -900s + fromSeconds(1e-6 * ppm * seconds(t - kBegin)); };
    const double error = largestClockError(outcome, 1, ahead);
    EXPECT_LT(error, 1e-3);
    measured(ppm > 0 ? "clock_error_us_fast" : "clock_error_us_slow", 1e6 * error);
    EXPECT_EQ(outcome.count(1, &LidarCounters::late), 0u);
  }
}

using F14Epoch = testing::TestWithParam<Duration>;

TEST_P(F14Epoch, thatDiffersAtTheStartIsAlignedWithANoticeAndNothingIsDiscarded)
{
  const Duration ahead = GetParam();
  const Rig rig = referenceRig();
  const Arrivals arrivals = stepped(drive(rig, 2s), 1, Timestamp::min(), ahead);
  const Outcome outcome = batch(rig, arrivals);
  const auto noticed = outcome.of(Notice::Kind::ClockAligned);
  ASSERT_EQ(noticed.size(), 1u);
  EXPECT_EQ(noticed.front().lidar, 1u);
  EXPECT_LE(noticed.front().when - kBegin, 1s);
  const double error = largestClockError(outcome, 1, [&](Timestamp) { return ahead; });
  EXPECT_LT(error, 1e-3);
  measured("clock_error_us", 1e6 * error);
  measured("noticed_after_ms", 1e3 * seconds(noticed.front().when - kBegin));
  EXPECT_GE(outcome.scans.front().columns_of[1], 1000u);
  EXPECT_EQ(outcome.count(1, &LidarCounters::late), 0u);
}
INSTANTIATE_TEST_SUITE_P(All, F14Epoch,
                         testing::Values(Duration{37s}, Duration{-37s}, Duration{-999s}, Duration{1700000000s},
                                         Duration{150ms}),
                         nameOfDuration);

TEST(F14, anotherEpochIsRefusedWhereTheConfigurationSaysSo)
{
  const Rig rig = referenceRig();
  TimeBatcher batcher = batcherOf(rig, withOtherClock("refuse"));
  Timestamp last{};
  const std::string said = messageOf<std::runtime_error>(
      [&]
      {
        for (const Arrival& a : stepped(drive(rig, 2s), 1, Timestamp::min(), -37s))
        {
          last = a.received;
          push(batcher, a.lidar, a.packet, a.received);
        }
      });
  EXPECT_NE(said.find("lidar2"), std::string::npos);
  EXPECT_NE(said.find("-36.99"), std::string::npos) << said;
  EXPECT_LE(last - kBegin, 1s);
}

TEST(F14, anotherEpochIsLeftOutWhereTheConfigurationSaysSo)
{
  const Rig rig = referenceRig();
  const Outcome outcome = batch(rig, stepped(drive(rig, 2s), 1, Timestamp::min(), -37s), withOtherClock("quarantine"));
  EXPECT_EQ(outcome.of(Notice::Kind::Quarantined).size(), 1u);
  EXPECT_EQ(outcome.count(1, &LidarCounters::emitted), 0u);
  EXPECT_GE(outcome.scans.size(), 18u);
  for (const Scan& scan : outcome.scans) EXPECT_TRUE(scan.missing.test(1));
}

TEST(F14, aLidarOfAnotherEpochThatComesLateIsAlignedFromItsFirstPacketOn)
{
  const Rig rig = referenceRig();
  Arrivals arrivals = stepped(drive(rig, 3s), 1, Timestamp::min(), -900s);
  removeIf(arrivals, [](const Arrival& a) { return a.lidar == 1 && a.sent < kBegin + 1s; });
  const Outcome outcome = batch(rig, arrivals);
  EXPECT_EQ(outcome.of(Notice::Kind::ClockAligned).size(), 1u);
  EXPECT_LT(largestClockError(outcome, 1, [](Timestamp) { return Duration{-900s}; }), 1e-3);
}

TEST(F23, stampsThatWrapEveryHourGoOnWithoutAJump)
{
  Rig rig = referenceRig();
  rig[2].stamp_modulus = 3600s;
  for (const Duration off :
       {Duration{0}, Duration{20min}, Duration{-25min}})  // the sensor's hour may begin at any time
  {
    Arrivals arrivals = drive(rig, 4s, Timestamp{3598s});
    Arrivals plain = arrivals;
    for (Arrival& a : arrivals)
      if (a.lidar == 2)
        eachBlock(a.packet,
                  [&](std::size_t at)
                  {
                    const std::int64_t hour = 3600000000000, stamp = load<std::int64_t>(a.packet, at) + off.count();
                    store<std::int64_t>(a.packet, at, ((stamp % hour) + hour) % hour);
                  });
    const Outcome outcome = batch(rig, arrivals);
    EXPECT_EQ(outcome.count(2, &LidarCounters::clock_steps) + outcome.count(2, &LidarCounters::restarts), 0u);
    EXPECT_EQ(outcome.count(2, &LidarCounters::lost) + outcome.count(2, &LidarCounters::late), 0u);
    EXPECT_EQ(outcome.count(2, &LidarCounters::doubtful_packets), 0u);
    EXPECT_LT(largestClockError(outcome, 2, [&](Timestamp) { return off; }), 1e-3);
    if (off == Duration{0})
    {
      EXPECT_EQ(others(outcome, 2), others(batch(rig, plain), 2));
    }
  }
}
}  // namespace scanloom::faults_of_clocks_unittest
