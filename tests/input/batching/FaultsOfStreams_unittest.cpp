// F7, F9 to F11 and F26 of the fault table: what lidars do, and damage to their packets.
#include <gtest/gtest.h>

#include "FaultRig.h"
#include "support/pushPacket.h"

namespace scanloom::faults_of_streams_unittest
{
namespace
{
/** From true time `from` on the lidar has started again: init id, frame ids, and its clock if `epoch` is given. */
Arrivals restarted(const Rig& rig, LidarIndex lidar, Duration length, Duration outage, std::optional<Duration> epoch)
{
  const Timestamp off = kBegin + 1s, on = off + outage;
  Arrivals arrivals = drive(rig, length);
  removeIf(arrivals, [&](const Arrival& a) { return a.lidar == lidar && a.sent >= off; });
  for (auto& packet : FakeLidar(rig[lidar]).drive(on, length - 1s - outage, 0))
  {
    const Timestamp sent = lastStampOf(packet);
    store<std::uint32_t>(packet, 0, 99);
    if (epoch) shiftStamps(packet, *epoch - on.time_since_epoch());
    arrivals.push_back({lidar, std::move(packet), sent + kDelay, sent});
  }
  inOrderOfArrival(arrivals);
  return arrivals;
}

struct Restart
{
  const char* name;
  bool has_init_id;
  Duration outage;
  std::optional<Duration> epoch;  // what its clock says at its first packet
};
}  // namespace

TEST(F7, damagedPacketsOfOneLidarLeaveTheOthersBitByBitAsTheyWere)
{
  const Rig rig = referenceRig();
  const Arrivals clean = drive(rig, 4s);
  const auto others = [](std::uint8_t id) { return id != 0; };
  const std::string expected = digestOf(batch(rig, clean).scans, others);
  for (unsigned seed = 1; seed <= 8; ++seed)
  {
    std::mt19937 random(seed);  // NOLINT
    const auto upTo = [&random](std::size_t most) { return random() % most; };
    Arrivals arrivals;
    for (const Arrival& a : clean)
    {
      arrivals.push_back(a);
      if (a.lidar != 0 || a.sent < kBegin + 300ms || upTo(3) != 0) continue;
      std::vector<std::uint8_t>& packet = arrivals.back().packet;
      switch (upTo(5))
      {
        case 0:
          packet.resize(upTo(packet.size()));
          break;
        case 1:
          packet.resize(upTo(65536));
          break;
        case 2:
          for (std::size_t flips = 1 + upTo(8); flips > 0; --flips)
            packet[upTo(packet.size())] ^= static_cast<std::uint8_t>(1u << upTo(8));
          break;
        case 3:  // random ids and stamps
          eachBlock(packet,
                    [&](std::size_t at)
                    {
                      store<std::uint64_t>(packet, at, (std::uint64_t{random()} << 32) | random());
                      store<std::uint32_t>(packet, at + 8, static_cast<std::uint32_t>(random()));
                      store<std::uint16_t>(packet, at + 12, static_cast<std::uint16_t>(random()));
                    });
          break;
        default:
          for (std::uint8_t& byte : packet) byte = static_cast<std::uint8_t>(random());
      }
    }
    const Outcome outcome = batch(rig, arrivals);
    EXPECT_EQ(digestOf(outcome.scans, others), expected) << "seed " << seed;
    EXPECT_EQ(outcome.count(0, &LidarCounters::restarts), 0u) << "seed " << seed;
    EXPECT_EQ(outcome.count(0, &LidarCounters::clock_steps), 0u) << "seed " << seed;
    EXPECT_GT(outcome.count(0, &LidarCounters::emitted), 64u * 16u * 20u) << "seed " << seed;
    measured("doubtful_packets_of_about_850_seed" + std::to_string(seed),
             static_cast<double>(outcome.count(0, &LidarCounters::doubtful_packets)));
  }
}

TEST(F9, frameIdsWrapWithoutLossAt16And32Bits)
{
  for (const std::uint64_t modulus : {std::uint64_t{65536}, std::uint64_t{1} << 32})
  {
    Rig rig = referenceRig();
    for (FakeLidarOptions& lidar : rig) lidar.frame_id_modulus = modulus;
    const Arrivals arrivals = drive(rig, 3s, kBegin, static_cast<std::uint32_t>(modulus - 15));
    const Outcome outcome = batch(rig, arrivals);
    for (const LidarCounters& c : outcome.counters)
      EXPECT_EQ(c.lost + c.late + c.restarts + c.doubtful_packets + c.duplicate, 0u);
  }
}

using F10Restart = testing::TestWithParam<Restart>;

TEST_P(F10Restart, isBackWithinTwoPeriodsOfItsFirstPacket)
{
  const Restart& fault = GetParam();
  Rig rig = referenceRig();
  rig[1].has_init_id = fault.has_init_id;
  const Arrivals arrivals = restarted(rig, 1, 6s, fault.outage, fault.epoch);
  const Outcome outcome = batch(rig, arrivals);

  const Timestamp on = kBegin + 1s + fault.outage;
  EXPECT_EQ(outcome.count(1, &LidarCounters::restarts), 1u);
  EXPECT_EQ(outcome.of(Notice::Kind::ClockAligned).size(), fault.epoch ? 1u : 0u);
  EXPECT_EQ(outcome.count(1, &LidarCounters::late), 0u);
  int back_after = 0;
  for (const Scan& scan : outcome.scans)
  {
    if (scan.end() <= on) continue;
    if (scan.columns_of[1] > 0) break;
    ++back_after;
  }
  EXPECT_LE(back_after, 1);
  measured("scans_without_it_after_its_first_packet", back_after);
  for (std::size_t k = 0; k + 1 < outcome.scans.size(); ++k)
  {
    if (outcome.scans[k].start < on + kPeriod) continue;
    EXPECT_TRUE(outcome.scans[k].complete());
    EXPECT_NEAR(outcome.scans[k].columns_of[1], 1024, 12);
  }
}
INSTANTIATE_TEST_SUITE_P(All, F10Restart,
                         testing::Values(Restart{"initIdAndPtp", true, 3s, std::nullopt},
                                         Restart{"initIdAndTimeFromZero", true, 500ms, Duration{2ms}},
                                         Restart{"legacyAndPtp", false, 500ms, std::nullopt},
                                         Restart{"legacyAndTimeFromZero", false, 3s, Duration{2ms}}),
                         [](const auto& tested) { return tested.param.name; });

TEST(F11, aChangeOfModeIsSeenAtTheFirstPacketAndCostsTheOthersNothing)
{
  const Rig rig = referenceRig();
  const Arrivals clean = drive(rig, 4s);
  FakeLidarOptions other_mode = ouster(20);
  other_mode.columns_per_frame = 2048;
  other_mode.columns_per_packet = 32;
  other_mode.last_column = 2047;

  const Timestamp from = kBegin + 1s, known = from + 500ms;
  Arrivals arrivals = clean;
  removeIf(arrivals, [&](const Arrival& a) { return a.lidar == 0 && a.sent >= from; });
  addPackets(arrivals, 0, FakeLidar(other_mode).drive(from + 300ms, 2s, 0));
  inOrderOfArrival(arrivals);

  TimeBatcher batcher = batcherOf(rig, {});
  std::vector<Scan> scans;
  bool replaced = false;
  std::optional<Timestamp> seen;
  for (const Arrival& a : arrivals)
  {
    if (!replaced && a.received > known)
    {
      replaced = true;
      batcher.replace(0, std::make_shared<FakeLidar>(other_mode));
    }
    for (Scan& scan : push(batcher, a.lidar, a.packet, a.received)) scans.push_back(std::move(scan));
    if (!seen && batcher.counters(0).malformed_packets == 1) seen = a.sent;
  }
  EXPECT_LE(*seen - (from + 300ms), 2 * kPacketTime);
  measured("seen_after_ms", 1e3 * seconds(*seen - (from + 300ms)));
  const auto others = [](std::uint8_t id) { return id != 0; };
  const auto reference = batch(rig, clean).scans;
  const std::vector<Scan> compared(reference.begin(), reference.begin() + static_cast<std::ptrdiff_t>(scans.size()));
  EXPECT_EQ(digestOf(scans, others), digestOf(compared, others));
  for (const Scan& scan : scans)
    if (scan.start > known + kPeriod && scan.end() < kBegin + 3200ms)
    {
      EXPECT_NEAR(scan.columns_of[0], 4096, 40);
    }
}

TEST(F11, aLidarMayBecomeKnownAfterTheStart)
{
  const Rig rig = referenceRig();
  std::vector<BatchedLidar> lidars = batcherOf(rig, {}).lidars();
  lidars[3].decoder.reset();
  TimeBatcher batcher(lidars, {});
  std::vector<Scan> scans;
  for (const Arrival& a : drive(rig, 3s))
  {
    if (!batcher.lidars()[3].decoder && a.received > kBegin + 1s)
      batcher.replace(3, std::make_shared<FakeLidar>(rig[3]));
    for (Scan& scan : push(batcher, a.lidar, a.packet, a.received)) scans.push_back(std::move(scan));
  }
  EXPECT_LE(scans.front().start, kBegin + 2 * kPeriod);
  EXPECT_TRUE(scans.front().missing.test(3));
  EXPECT_TRUE(scans.back().complete());
  EXPECT_EQ(scans.back().columns_of[3], 2048u);
}

TEST(F26, whatALidarSaysOfItsHealthIsKnownWithTheSameScan)
{
  const Rig rig = referenceRig();
  Arrivals arrivals = drive(rig, 2s);
  const Timestamp hot = kBegin + 1s, cool = kBegin + 1500ms;
  for (Arrival& a : arrivals)
  {
    if (a.lidar != 0 || a.sent < hot || a.sent >= cool) continue;
    a.packet[4] = 0x41;
    a.packet[5] = 1;  // thermal shutdown imminent
    a.packet[6] = 2;  // shot limiting
  }
  const Outcome outcome = batch(rig, arrivals);
  const auto alerts = outcome.of(Notice::Kind::Alert);
  ASSERT_EQ(alerts.size(), 2u);  // it begins and it ends
  EXPECT_EQ(alerts[0].flags, 0x00020141u);
  EXPECT_LE(alerts[0].when - hot, 2 * kPacketTime);
  measured("known_after_ms", 1e3 * seconds(alerts[0].when - hot));
  EXPECT_EQ(alerts[1].flags, 0u);
  EXPECT_NEAR(static_cast<double>(outcome.count(0, &LidarCounters::alert_packets)), 320, 1);
}
}  // namespace scanloom::faults_of_streams_unittest
