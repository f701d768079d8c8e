/** Velodyne packets, recorded ones and some at the top of the hour, all the way into scans. */
#include <gtest/gtest.h>

#include <algorithm>

#include "../lidar/velodynePackets.h"
#include "input/batching/TimeBatcher.h"
#include "input/packets/CaptureReader.h"
#include "support/TestData.h"
#include "support/pushPacket.h"

namespace scanloom::velodyne_replay_unittest
{
namespace
{
struct Arrived
{
  std::vector<std::uint8_t> packet;
  Timestamp received;
};

struct Outcome
{
  std::vector<Column> columns;
  LidarCounters counters;
  std::vector<Notice> notices;
};

Outcome batch(const VelodyneMetadata& metadata, const std::vector<Arrived>& stream)
{
  TimeBatcher batcher({{"roof", makeVelodyne(metadata, Rigid::identity()), Duration{0}}}, {});
  Outcome outcome;
  const auto take = [&](const std::vector<Scan>& scans)
  {
    for (const Scan& scan : scans)
      outcome.columns.insert(outcome.columns.end(), scan.columns.begin(), scan.columns.end());
  };
  for (const Arrived& a : stream) take(push(batcher, 0, a.packet, a.received));
  take(batcher.finish());
  outcome.counters = batcher.counters(0);
  outcome.notices = batcher.takeNotices();
  return outcome;
}

/** Shortest and longest time from one column to the next. */
std::pair<Duration, Duration> spacing(const std::vector<Column>& columns)
{
  std::pair<Duration, Duration> range{Duration::max(), Duration{0}};
  for (std::size_t i = 1; i < columns.size(); ++i)
  {
    range.first = std::min(range.first, columns[i].stamp - columns[i - 1].stamp);
    range.second = std::max(range.second, columns[i].stamp - columns[i - 1].stamp);
  }
  return range;
}

void expectNothingMissing(const LidarCounters& c)
{
  EXPECT_EQ(c.received, c.emitted + c.before_start);
  EXPECT_EQ(c.lost + c.doubtful_packets + c.malformed_packets + c.restarts + c.clock_steps, 0u);
}

constexpr Timestamp kReceived{1'700'000'000s};

/** Packets of a VLP-16 at 600 rpm; its hour ends after the first second. */
std::vector<Arrived> aroundTheTopOfTheHour(int returns)
{
  std::vector<Arrived> stream;
  const Duration packet = 24 / returns * 55296ns;
  for (Duration t{0}; t < 3s; t += packet)
  {
    VelodyneContent content;
    content.return_mode = returns == 2 ? 0x39 : 0x37;
    const auto us = (3'599'000'000'000 + t.count()) / 1000 % 3'600'000'000;
    content.microseconds = static_cast<std::uint32_t>(us);
    content.azimuth = static_cast<int>(seconds(t) * 360'000) % 36000;
    stream.push_back({velodynePacket(content), kReceived + t + packet + 100us});
  }
  return stream;
}
}  // namespace

class VelodyneReturns : public testing::TestWithParam<int>
{
};
INSTANTIATE_TEST_SUITE_P(OneAndTwo, VelodyneReturns, testing::Values(1, 2));

TEST_P(VelodyneReturns, passTheTopOfTheHourWithoutAJump)
{
  VelodyneMetadata metadata = velodyneMetadata("vlp16");
  metadata.returns = GetParam();
  const Outcome outcome = batch(metadata, aroundTheTopOfTheHour(GetParam()));
  expectNothingMissing(outcome.counters);
  EXPECT_TRUE(outcome.notices.empty());
  const auto [shortest, longest] = spacing(outcome.columns);
  EXPECT_GE(shortest, 54ns * 1000) << "stamps are in whole microseconds";
  EXPECT_LE(longest, 57ns * 1000);
}

TEST(VelodyneFieldOfView, losesNoBlockBehindItsGap)
{
  VelodyneMetadata metadata = velodyneMetadata("vlp16");
  std::vector<Arrived> stream;
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
    stream.push_back({packet, kReceived + t + 100us});
  }
  const Outcome outcome = batch(metadata, stream);
  EXPECT_EQ(outcome.counters.received, outcome.counters.emitted + outcome.counters.before_start);
  const auto [shortest, longest] = spacing(outcome.columns);
  EXPECT_GT(shortest, 50us);
  EXPECT_NEAR(seconds(longest), 0.05, 1e-3);
}

struct Recording
{
  const char* model;
  const char* file;
  std::uint64_t packets;
};
class VelodyneReplay : public testing::TestWithParam<Recording>
{
};
INSTANTIATE_TEST_SUITE_P(
    Recordings, VelodyneReplay,
    testing::Values(Recording{"vlp16", "Kitware+VeloView/Testing/Data/vlp-16-test-90deg-1-50-frames.pcap", 1902},
                    Recording{"hdl32e", "Kitware+VeloView/Testing/Data/monterey-first-100-packets.pcap", 2702}),
    [](const auto& recording) { return std::string(recording.param.model); });

TEST_P(VelodyneReplay, losesNothing)
{
  SCANLOOM_NEEDS_DATA(capture, std::string("other-lidars/") + GetParam().file);
  VelodyneMetadata metadata = velodyneMetadata(GetParam().model);
  metadata.product_id = 0x21;  // the VLP-16 is an early one that says HDL-32E
  std::vector<Arrived> stream;
  CaptureReader reader(capture);
  for (Datagram datagram; reader.next(datagram);)
    if (datagram.destination_port == 2368) stream.push_back({datagram.payload, datagram.received});

  const Outcome outcome = batch(metadata, stream);
  EXPECT_EQ(outcome.counters.packets, GetParam().packets);
  expectNothingMissing(outcome.counters);
  const auto [shortest, longest] = spacing(outcome.columns);
  EXPECT_GE(shortest, metadata.model->period - 2us);
  EXPECT_LE(longest, metadata.model->period + 2us);
}
}  // namespace scanloom::velodyne_replay_unittest
