/** Every configurable fault, as batcher and decoder see it. */
#include "input/lidar/OusterDecoder.h"
#include "input/rig/Extrinsics.h"
#include "lab/simulation/internal/ScenePackets.h"
#include "support/SceneInput.h"
#include "support/with.h"

#include <gmock/gmock.h>

#include <functional>
#include <map>
#include <set>

namespace scanloom::lidar_faults_unittest
{
namespace
{
using testing::HasSubstr;

/** Few beams in an empty world; the left lidar gets the faults. */
SimulationSettings twoSmallLidars(double duration = 4)
{
  SimulationSettings settings;
  settings.drive.route = "work";
  settings.drive.duration = duration;
  settings.drive.speed_up = 1;
  settings.forest.stand.stems_per_hectare = 0;
  settings.lidars[0].model = "OS0-8";
  return settings;
}

struct Received
{
  RigAccount account;
  std::vector<Scan> scans;
  std::string warnings;

  const LidarCounters& left() const { return account.lidars[0].counters; }
  const LidarCounters& right() const { return account.lidars[1].counters; }
};

Received batched(const SimulationSettings& settings)
{
  const auto scene = std::make_shared<const Scene>(makeScene(settings, 1));
  const auto input = makeSceneInput(scene, rigOf(*scene, with(&BatcherOptions::deadline_ms, 50)));
  Received received;
  while (auto event = input->next())
    if (auto* scan = std::get_if<Scan>(&*event)) received.scans.push_back(std::move(*scan));
  received.account = input->account();
  for (const std::string& warning : input->takeWarnings()) received.warnings += warning + '\n';
  return received;
}

/** The left lidar's packets in the order of receipt. */
void forEachLeft(const SimulationSettings& settings,
                 const std::function<void(const Datagram&, const OusterDecoder&)>& visit)
{
  const Scene scene = makeScene(settings, 1);
  const OusterDecoder decoder(scene.lidars[0].metadata(), Rigid::identity());
  ScenePackets packets(scene);
  for (Datagram datagram; packets.next(datagram);)
    if (datagram.destination_port == 7502) visit(datagram, decoder);
}

TEST(LidarFaults, areNoneUnlessAskedFor)
{
  const Received received = batched(twoSmallLidars());
  for (const LidarAccount& lidar : received.account.lidars)
  {
    EXPECT_EQ(lidar.counters.lost + lidar.counters.late + lidar.counters.duplicate + lidar.counters.invalid +
                  lidar.counters.implausible + lidar.counters.doubtful_packets + lidar.counters.restarts,
              0u);
    EXPECT_NEAR(static_cast<double>(lidar.counters.received), 4 * 5120, 0.1 * 5120 + 16);
  }
  EXPECT_EQ(received.warnings, "");
}

TEST(LidarFaults, lossIsTheShareThatWasAskedFor)
{
  SimulationSettings settings = twoSmallLidars();
  settings.lidars[0].faults.loss = 0.1;
  const Received received = batched(settings);
  EXPECT_NEAR(static_cast<double>(received.left().lost) / static_cast<double>(received.left().sent()), 0.1, 0.03);
  EXPECT_EQ(received.right().lost, 0u);
}

TEST(LidarFaults, burstsLoseAllPacketsForTheirLengthAtTheirRate)
{
  SimulationSettings settings = twoSmallLidars(10);
  settings.lidars[0].faults.burst_every = 1;
  settings.lidars[0].faults.burst_length = 0.05;
  const Received received = batched(settings);
  const double share = static_cast<double>(received.left().lost) / static_cast<double>(received.left().sent());
  EXPECT_NEAR(share, 0.05, 0.02);

  Timestamp last;
  int gaps = 0;
  forEachLeft(settings,
              [&](const Datagram& datagram, const OusterDecoder&)
              {
                gaps += last != Timestamp{} && datagram.received - last > 40ms;
                last = datagram.received;
              });
  EXPECT_NEAR(gaps, 10, 2);
}

TEST(LidarFaults, reorderedPacketsAreAllThereAfterOthers)
{
  SimulationSettings settings = twoSmallLidars();
  settings.lidars[0].faults.reordered = 0.05;
  const Received received = batched(settings);
  EXPECT_EQ(received.left().lost + received.left().late, 0u) << "the deadline is long enough to sort them";

  int backwards = 0, packets = 0;
  std::int64_t newest = -1;
  std::vector<MeasurementBlock> blocks;
  forEachLeft(settings,
              [&](const Datagram& datagram, const OusterDecoder& decoder)
              {
                decoder.readBlocks(datagram.payload, blocks);
                const std::int64_t stamp = nanoseconds(blocks.front().stamp);
                backwards += stamp < newest;
                newest = std::max(newest, stamp);
                ++packets;
              });
  EXPECT_NEAR(static_cast<double>(backwards) / packets, 0.05, 0.02);
}

TEST(LidarFaults, duplicatesAreCounted)
{
  SimulationSettings settings = twoSmallLidars();
  settings.lidars[0].faults.duplicated = 0.05;
  const Received received = batched(settings);
  EXPECT_NEAR(static_cast<double>(received.left().duplicate) / static_cast<double>(received.left().received), 0.048,
              0.02);
  EXPECT_EQ(received.left().lost, 0u);
}

TEST(LidarFaults, aSilentSensorIsSilentAsLongAsItWasTold)
{
  SimulationSettings settings = twoSmallLidars(6);
  settings.lidars[0].faults.silent_from = 2;
  settings.lidars[0].faults.silent_to = 4;
  Timestamp last;
  Duration longest{0};
  forEachLeft(settings,
              [&](const Datagram& datagram, const OusterDecoder&)
              {
                if (last != Timestamp{}) longest = std::max(longest, datagram.received - last);
                last = datagram.received;
              });
  EXPECT_NEAR(seconds(longest), 2.0, 0.01);

  const Received received = batched(settings);
  EXPECT_THAT(received.warnings, HasSubstr("left"));
  EXPECT_GE(received.left().missed_scans, 18u);
  EXPECT_GE(received.scans.size(), 57u) << "the right one goes on";
}

TEST(LidarFaults, aRestartBringsAnotherInitIdAndCountsFromZero)
{
  SimulationSettings settings = twoSmallLidars(6);
  settings.lidars[0].faults.restart_at = 2;
  settings.lidars[0].faults.restart_takes = 1;
  std::map<std::uint32_t, std::vector<MeasurementBlock>> by_init_id;
  std::vector<MeasurementBlock> blocks;
  const auto initIdOf = [](const Datagram& datagram)  // header of packets: init id of 24 bits at byte 4
  { return datagram.payload[4] | datagram.payload[5] << 8 | datagram.payload[6] << 16; };
  forEachLeft(settings,
              [&](const Datagram& datagram, const OusterDecoder& decoder)
              {
                decoder.readBlocks(datagram.payload, blocks);
                auto& all = by_init_id[static_cast<std::uint32_t>(initIdOf(datagram))];
                all.insert(all.end(), blocks.begin(), blocks.end());
              });
  ASSERT_EQ(by_init_id.size(), 2u);
  const auto &before = by_init_id.begin()->second, &after = by_init_id.rbegin()->second;
  EXPECT_EQ(by_init_id.rbegin()->first, by_init_id.begin()->first + 1);
  EXPECT_NEAR(seconds(before.back().stamp - before.front().stamp), 1.95, 0.06);
  EXPECT_EQ(after.front().frame_id, 0u);
  EXPECT_EQ(after.front().measurement_id, 0u);
  EXPECT_LT(after.front().stamp, Timestamp{1ms});
  EXPECT_NEAR(seconds(after.back().stamp - Timestamp{}), 3.0, 0.01);

  const Received received = batched(settings);
  EXPECT_EQ(received.left().restarts, 1u) << received.warnings;
  EXPECT_EQ(received.right().restarts, 0u);
}

TEST(LidarFaults, clocksAreOffDriftAndJumpAsTheyWereTold)
{
  SimulationSettings settings = twoSmallLidars();
  const auto stampsOf = [](const SimulationSettings& s)
  {
    std::vector<Timestamp> stamps;
    std::vector<MeasurementBlock> blocks;
    forEachLeft(s,
                [&](const Datagram& datagram, const OusterDecoder& decoder)
                {
                  decoder.readBlocks(datagram.payload, blocks);
                  stamps.push_back(blocks.front().stamp);
                });
    return stamps;
  };
  const auto right = stampsOf(settings);
  settings.lidars[0].clock.clock_offset = 0.25;
  settings.lidars[0].clock.clock_drift_ppm = 100;
  settings.lidars[0].clock.clock_jump = -0.5;
  settings.lidars[0].clock.clock_jump_at = 2;
  const auto wrong = stampsOf(settings);
  ASSERT_EQ(wrong.size(), right.size());
  for (std::size_t i = 0; i < right.size(); ++i)
  {
    const double t = seconds(right[i] - Timestamp{1'750'000'000s});
    const double expected = 0.25 + 1e-4 * t - (t >= 2 ? 0.5 : 0);
    EXPECT_NEAR(seconds(wrong[i] - right[i]), expected, 2e-9) << i;
  }

  EXPECT_GE(batched(settings).left().clock_steps, 1u);
}

TEST(LidarFaults, aWindowedSensorSendsItsWindowAndMarksTheRest)
{
  SimulationSettings settings = twoSmallLidars();
  settings.lidars[0].window = "104 311";  // begins and ends inside of packets
  std::set<int> valid, invalid;
  std::vector<MeasurementBlock> blocks;
  forEachLeft(settings,
              [&](const Datagram& datagram, const OusterDecoder& decoder)
              {
                decoder.readBlocks(datagram.payload, blocks);
                for (const MeasurementBlock& block : blocks)
                  (block.valid ? valid : invalid).insert(block.measurement_id);
              });
  EXPECT_EQ(valid.size(), 208u);
  EXPECT_EQ(*valid.begin(), 104);
  EXPECT_EQ(*valid.rbegin(), 311);
  EXPECT_EQ(invalid.size(), 16u) << "8 in the first packet, 8 in the last";

  const Received received = batched(settings);
  EXPECT_EQ(received.left().lost, 0u) << "a window is no loss";
  EXPECT_GE(received.scans.size(), 38u);
}

TEST(LidarFaults, extrinsicsAreWrongByTheErrorAndThePacketsAreNot)
{
  SimulationSettings settings = twoSmallLidars();
  const Scene right = makeScene(settings, 1);
  settings.lidars[0].faults.pose_error = "0.02 0 0 1 0 0";
  const Scene wrong = makeScene(settings, 1);

  const Rigid error = right.lidars[0].written_body_T_sensor.inverse() * wrong.lidars[0].written_body_T_sensor;
  EXPECT_LT(boxMinus(error, Rigid::fromXyzYawPitchRoll(0.02, 0, 0, M_PI / 180, 0, 0)).norm(), 1e-12);
  ScenePackets a(right), b(wrong);
  Datagram of_a, of_b;
  for (int i = 0; i < 500; ++i)
  {
    ASSERT_TRUE(a.next(of_a) && b.next(of_b));
    ASSERT_EQ(of_a.payload, of_b.payload);
  }
}
}  // namespace
}  // namespace scanloom::lidar_faults_unittest
