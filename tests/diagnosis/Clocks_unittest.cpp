/** ClockKind, ClockSteps, ClockDrift and RotorPhase against clocks that were set wrong on purpose. */
#include <gtest/gtest.h>

#include <random>

#include "diagnosis/internal/ClockDrift.h"
#include "diagnosis/internal/ClockKind.h"
#include "diagnosis/internal/RigExamination.h"
#include "diagnosis/internal/RotorPhase.h"
#include "input/rig/Rig.h"
#include "support/TestData.h"
#include "support/mergedCaptures.h"
#include "traces.h"

namespace scanloom::clocks_unittest
{
namespace
{
const LidarDescription kLidar = smallLidar();
const Timestamp kStart{1750000000s};

std::vector<Arrival> arrivalsOf(const std::vector<PacketTrace>& traces)
{
  return arrivalsOn(packetRuns(traces, kLidar), kLidar, 1ms);
}

/** Packets are on their way for 0.1 ms and, as in a real network, an exponentially distributed time of 0.1 ms. */
std::vector<PacketTrace> networked(int turns, double ppm, unsigned seed)
{
  std::mt19937 random(seed);
  std::exponential_distribution<double> wait(1e4);
  return tracesOf(kLidar, turns,
                  [&](std::int64_t, PacketTrace& trace)
                  {
                    trace.received = *trace.stamp + fromSeconds(1e-4 + wait(random));
                    *trace.stamp += fromSeconds(1e-6 * ppm * seconds(*trace.stamp - kStart));
                  });
}
}  // namespace

TEST(ClockKind, isToldFromTheStampAtArrival)
{
  const Timestamp now{1750000000s};
  EXPECT_EQ(epochOf(now - 3ms, now), Epoch::Utc);
  EXPECT_EQ(epochOf(now + 37s, now), Epoch::Tai);
  EXPECT_EQ(epochOf(now + 18s, now), Epoch::GpsAsUnix);
  EXPECT_EQ(epochOf(Timestamp{1434035218s}, now), Epoch::Gps);  // week 2371, 2025-06-15: 1750000000 - 315964782
  EXPECT_EQ(epochOf(Timestamp{3600s}, now), Epoch::SinceBoot);
  EXPECT_EQ(epochOf(now - 100h, now), Epoch::Other);
}

TEST(ClockSteps, areFoundWithTheirSizeBetweenTwoPackets)
{
  const auto traces = tracesOf(kLidar, 50,
                               [](std::int64_t n, PacketTrace& trace)
                               {
                                 if (n >= 200) *trace.stamp += 37s;
                                 if (n >= 300) *trace.stamp -= 5ms;
                               });
  const auto steps = clockSteps(packetRuns(traces, kLidar), kLidar, 1ms);
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].size, 37s);
  EXPECT_EQ(steps[0].at, *traces[199].stamp);
  EXPECT_EQ(steps[1].size, -5ms);
}

TEST(ClockSteps, aRotorThatIsSlowerThanNominalIsNoStepNorIsALostSecond)
{
  auto traces = tracesOf(kLidar, 50,
                         [](std::int64_t, PacketTrace& trace)
                         { *trace.stamp += fromSeconds(0.005 * seconds(*trace.stamp - kStart)); });
  traces.erase(traces.begin() + 100, traces.begin() + 180);
  EXPECT_TRUE(clockSteps(packetRuns(traces, kLidar), kLidar, 1ms).empty());
}

TEST(ClockSteps, stampsBeforeAStepAreMovedOntoTheClockAfterIt)
{
  const auto arrivals = arrivalsOf(tracesOf(kLidar, 50,
                                            [](std::int64_t n, PacketTrace& trace)
                                            {
                                              if (n >= 200) *trace.stamp += 37s;
                                            }));
  ASSERT_EQ(arrivals.size(), 400u);
  for (const Arrival& arrival : arrivals) EXPECT_EQ(arrival.delay(), 1ms - 37s);
}

TEST(ClockDrift, isMeasuredWithinItsOwnUncertainty)
{
  for (const double ppm : {0.0, 40.0, -40.0, 2.0})
    for (const unsigned seed : {1u, 2u, 3u})
    {
      const auto drift = clockDrift(arrivalsOf(networked(300, ppm, seed)), 5s);
      ASSERT_TRUE(drift);
      EXPECT_LT(drift->sigma_ppm, 1) << "seed " << seed;
      EXPECT_NEAR(drift->ppm, ppm, 4 * drift->sigma_ppm) << "seed " << seed;
    }
}

TEST(ClockDrift, isNotGuessedFromTooLittleTime)
{
  EXPECT_FALSE(clockDrift(arrivalsOf(networked(49, 40, 1)), 5s));
  EXPECT_FALSE(clockDrift({}, 5s));
}

TEST(ArrivalJitter, isWhatWasAddedToTheWayOfTheFastest)
{
  const auto traces = tracesOf(kLidar, 200,
                               [](std::int64_t n, PacketTrace& trace)
                               {
                                 if (n % 10 == 5) trace.received += 2ms;  // of 1600: 10 %
                                 if (n == 805) trace.received += 5ms;
                               });
  const auto jitter = arrivalJitter(arrivalsOf(traces), std::nullopt, 5ms);
  ASSERT_TRUE(jitter);
  EXPECT_EQ(jitter->p50, 0ms);
  EXPECT_EQ(jitter->p99, 2ms);
  EXPECT_EQ(jitter->largest, 7ms);
  EXPECT_DOUBLE_EQ(jitter->late_share, 1.0 / 1600);
}

TEST(ArrivalJitter, isNotTheDrift)
{
  const auto arrivals = arrivalsOf(networked(3000, 40, 1));  // 300 s: 12 ms apart in the end
  const auto jitter = arrivalJitter(arrivals, clockDrift(arrivals, 5s), 5ms);
  EXPECT_LT(jitter->largest, 2ms);
}

TEST(RotorPhase, isWhereColumnZeroWasPassed)
{
  const LidarDescription lidar = smallLidar();
  std::vector<PacketTrace> traces;
  for (std::int64_t n = 0; n < 400; ++n) traces.push_back(nthTrace(lidar, n, kStart + 30ms));
  const auto phase = rotorPhase(packetRuns(traces, lidar), lidar, 1ms);
  ASSERT_TRUE(phase);
  EXPECT_NEAR(phase->at_start, 0.030, 1e-9);
  EXPECT_NEAR(phase->at_end, 0.030, 1e-9);
  EXPECT_TRUE(phase->steady());
}

TEST(RotorPhase, wandersWhereTheRotorIsFree)
{
  constexpr double kFast = 400e-6;
  const auto traces = tracesOf(kLidar, 300,
                               [](std::int64_t, PacketTrace& trace)
                               { *trace.stamp -= fromSeconds(kFast / (1 + kFast) * seconds(*trace.stamp - kStart)); });
  const auto phase = rotorPhase(packetRuns(traces, kLidar), kLidar, 1ms);
  ASSERT_TRUE(phase);
  EXPECT_NEAR(phase->rate_error_ppm, 400, 0.1);
  EXPECT_FALSE(phase->steady());
  EXPECT_NEAR(phase->at_end, 0.1 - 299 * 0.1 * kFast / (1 + kFast), 1e-5);
}

TEST(RotorPhase, needsTurns)
{
  EXPECT_FALSE(rotorPhase(packetRuns(tracesOf(kLidar, 2), kLidar), kLidar, 1ms));
  EXPECT_FALSE(rotorPhase({}, kLidar, 1ms));
}

TEST(RotorPhase, ofARecordedVelodyneIsThatOfItsAzimuths)
{
  // By the azimuth and time fields of the first and last packets' own bytes: 706.50 rpm, while the metadata says 600.
  SCANLOOM_NEEDS_DATA(capture, "other-lidars/Kitware+VeloView/Testing/Data/monterey-first-100-packets.pcap");
  RigSettings settings;
  settings.rig.pcap_input = capture;
  settings.lidars.resize(1);
  settings.lidars.front().metadata = SCANLOOM_SOURCE_DIR "/params/lidars/velodyne_hdl32e.json";
  const Rig rig = makeRig(settings);
  RigListener listener(rig, false);
  MergedCaptures captures = mergedCaptures(rig.captures);
  double hundredths = 0;
  std::optional<std::pair<int, std::uint32_t>> first, last;  // azimuth, us
  for (Datagram datagram; captures.next(datagram);)
  {
    listener.add(datagram);
    if (datagram.payload.size() != 1206) continue;
    const int azimuth = load<std::uint16_t>(datagram.payload, 2);
    if (last) hundredths += (azimuth - last->first + 36000) % 36000;
    last = {azimuth, load<std::uint32_t>(datagram.payload, 1200)};
    if (!first) first = last;
  }
  const double rate = hundredths / 36000 / (1e-6 * (last->second - first->second));
  const RigExamination seen = examine(listener.finish());
  EXPECT_NEAR(10 * (1 + 1e-6 * seen.lidars.front().clock.phase->rate_error_ppm), rate, 0.005 * rate);
  EXPECT_NEAR(60 * rate, 706.5, 0.1);
  EXPECT_EQ(seen.lidars.front().delivery.loss.packets, 0u);
  EXPECT_EQ(seen.lidars.front().delivery.order.duplicates, 0u);
}
}  // namespace scanloom::clocks_unittest
