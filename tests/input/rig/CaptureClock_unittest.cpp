#include "input/rig/internal/CaptureClock.h"

#include <gmock/gmock.h>

#include "liveRig.h"
#include "support/with.h"

namespace scanloom::capture_clock_unittest
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;

RoutedPacket packet(LidarIndex lidar, Timestamp stamp, Timestamp received)
{
  RoutedPacket packet;
  packet.lidar = lidar;
  packet.received = received;
  packet.blocks.resize(1);
  packet.blocks.front().stamp = stamp;
  packet.blocks.front().valid = true;
  return packet;
}

/** Two lidars' packets every 5 ms for a second; `alter` may change what they look like to the one who captures. */
template <typename Alter>
CaptureClock observed(Alter&& alter)
{
  CaptureClock clock(2);
  for (int i = 0; i < 200; ++i)
    for (LidarIndex lidar : {0u, 1u})
    {
      Timestamp stamp{1000s + 5ms * i}, received = Timestamp{5000s + 5ms * i + 1ms * static_cast<int>(lidar)};
      alter(i, lidar, stamp, received);
      clock.steady(packet(lidar, stamp, received));
    }
  return clock;
}

TEST(CaptureClock, knowsAStepByTheLidarsThatRunOn)
{
  for (const Duration step : {Duration{3600s}, Duration{-37s}, Duration{600ms}, Duration{24h * 365 * 40}})
  {
    CaptureClock clock = observed(
        [step](int i, LidarIndex, Timestamp&, Timestamp& received)
        {
          if (i >= 100) received += step;
        });
    EXPECT_EQ(clock.takeStep(), step);
    EXPECT_EQ(clock.takeStep(), std::nullopt) << "once";
    EXPECT_EQ(clock.steady(packet(0, Timestamp{1001s}, Timestamp{5001s} + step)), Timestamp{5001s});
  }
}

TEST(CaptureClock, silenceOfAllSensorsIsNoStep)
{
  CaptureClock clock = observed(
      [](int i, LidarIndex, Timestamp& stamp, Timestamp& received)
      {
        if (i < 100) return;
        stamp += 3s;
        received += 3s;
      });
  EXPECT_EQ(clock.takeStep(), std::nullopt);
}

TEST(CaptureClock, aLidarsOwnStepIsNone)
{
  CaptureClock clock = observed(
      [](int i, LidarIndex lidar, Timestamp& stamp, Timestamp&)
      {
        if (i >= 100 && lidar == 1) stamp += 37s;
      });
  EXPECT_EQ(clock.takeStep(), std::nullopt);
}

TEST(CaptureClock, restartedSensorsAfterAPauseAreNoStep)
{
  CaptureClock clock = observed(
      [](int i, LidarIndex, Timestamp& stamp, Timestamp& received)
      {
        if (i < 100) return;
        stamp -= 990s;
        received += 8s;
      });
  EXPECT_EQ(clock.takeStep(), std::nullopt);
}

struct Streamed
{
  std::vector<Scan> scans;
  std::vector<std::string> warnings;
};

Streamed stream(const Rig& rig, const std::vector<Datagram>& datagrams)
{
  RigStream stream(rig, RigStream::ReceiveTimes::OfCapture);
  const std::vector<SensorEvent> events = eventsOf(stream, datagrams);
  return {scansIn(events), stream.takeWarnings()};
}

/** Of two lidars one shows TAI, the other UTC; the IMU inside the other sends before its lidar does. */
TEST(RigStream, stampsAnEarlyImuSampleByTheClockThatItsLidarTurnsOutToHave)
{
  LiveRig lidars(2, LiveRig::Ports::Several, with(&FakeLidarOptions::has_imu, true));
  lidars.rig.addresses[1].imu_port = lidars.rig.addresses[1].lidar_port;
  std::vector<Datagram> sent = lidars.drive(2s);
  std::size_t late = 0;
  const auto of_utc = lidars.lidar->drive(Timestamp{1000s - 37s}, 2s);
  for (Datagram& datagram : sent)
    if (datagram.source == LiveRig::addressOf(1)) datagram.payload = of_utc[late++];
  sent.insert(sent.begin(), {Timestamp{1000s}, LiveRig::addressOf(1), 0, lidars.rig.addresses[1].imu_port,
                             FakeLidar::imuPacket(Timestamp{1000s - 37s}, 7)});
  RigStream stream(lidars.rig, RigStream::ReceiveTimes::OfCapture);
  std::vector<Timestamp> stamps;
  for (const SensorEvent& event : eventsOf(stream, sent))
    if (const auto* imu = std::get_if<SensorImu>(&event)) stamps.push_back(imu->sample.stamp);
  ASSERT_EQ(stamps.size(), 1u);
  EXPECT_LT(std::chrono::abs(stamps[0] - Timestamp{1000s}), 100ms);
}

TEST(RigStream, givesTheSameScansWhenTheClockOfTheCapturingComputerIsSet)
{
  const LiveRig lidars(2);
  const std::vector<Datagram> sent = lidars.drive(2s);
  const Streamed undisturbed = stream(lidars.rig, sent);
  EXPECT_TRUE(undisturbed.warnings.empty());
  for (const Duration step : {Duration{3600s}, Duration{-3600s}})
  {
    std::vector<Datagram> stepped = sent;
    for (std::size_t i = sent.size() / 2; i < sent.size(); ++i) stepped[i].received += step;
    const Streamed seen = stream(lidars.rig, stepped);
    ASSERT_EQ(seen.scans.size(), undisturbed.scans.size());
    for (std::size_t i = 0; i < seen.scans.size(); ++i) expectTheSame(seen.scans[i], undisturbed.scans[i]);
    EXPECT_THAT(seen.warnings, ElementsAre(HasSubstr(step > 0s ? "+3600.000 s" : "-3600.000 s")));
  }
}
}  // namespace
}  // namespace scanloom::capture_clock_unittest
