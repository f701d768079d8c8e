// What fuzzing found: each of these failed once.
#include <gtest/gtest.h>

#include <limits>

#include "FaultRig.h"
#include "input/batching/internal/PacketConsensus.h"
#include "support/pushPacket.h"
#include "support/with.h"

namespace scanloom::findings_unittest
{
namespace
{
/** The batcher with everything that came out of it. */
struct Session
{
  Session(const Rig& rig, const BatcherOptions& options) : batcher(batcherOf(rig, options)) {}

  void push(LidarIndex lidar, const std::vector<std::uint8_t>& packet, Timestamp received)
  {
    take(scanloom::push(batcher, lidar, packet, received));
  }
  void take(std::vector<Scan> more)
  {
    for (Scan& scan : more) scans.push_back(std::move(scan));
  }
  std::size_t columns() const
  {
    std::size_t count = 0;
    for (const Scan& scan : scans) count += scan.columns.size();
    return count;
  }

  TimeBatcher batcher;
  std::vector<Scan> scans;
};
}  // namespace

TEST(Findings, whatWaitsOfALidarReplacedBeforeTheStartIsCounted)
{
  const Rig rig{ouster(10)};
  Session session(rig, {});
  const auto packets = FakeLidar(rig[0]).drive(kBegin, 10ms);
  session.push(0, packets[0], lastStampOf(packets[0]));
  session.batcher.replace(0, std::make_shared<FakeLidar>(rig[0]));
  session.take(session.batcher.finish());
  EXPECT_EQ(session.batcher.counters(0).received, 16u);
  EXPECT_EQ(session.batcher.counters(0).before_start, 16u);
}

TEST(Findings, aLidarOfAnotherClockReplacedBeforeTheStartDoesNotCarryTheOthersAway)
{
  const Rig rig{ouster(10), ouster(10)};
  Session session(rig, withOtherClock("quarantine"));
  Arrivals arrivals = drive(rig, 40ms);
  for (Arrival& a : arrivals)
  {
    if (a.lidar == 1) shiftStamps(a.packet, 3600s);
    session.push(a.lidar, a.packet, a.received);
  }
  session.batcher.replace(1, std::make_shared<FakeLidar>(rig[1]));
  session.take(session.batcher.finish());
  EXPECT_LE(session.scans.size(), 2u) << "not an hour of them";
}

TEST(Findings, noBlockComesTwiceAcrossAReplacement)
{
  const Rig rig{ouster(10)};
  Session session(rig, {});
  const auto packets = FakeLidar(rig[0]).drive(kBegin, 150ms);
  for (const auto& packet : packets) session.push(0, packet, lastStampOf(packet) + kDelay);
  session.batcher.replace(0, std::make_shared<FakeLidar>(rig[0]));
  session.push(0, packets.back(), lastStampOf(packets.back()) + kDelay);
  session.take(session.batcher.finish());
  for (const Scan& scan : session.scans)
    for (std::size_t i = 1; i < scan.columns.size(); ++i) EXPECT_LT(scan.columns[i - 1].stamp, scan.columns[i].stamp);
  EXPECT_EQ(session.batcher.counters(0).late, 16u);
}

TEST(Findings, whereEveryLidarIsQuarantinedScansStopInsteadOfRunningOn)
{
  const Rig rig{ouster(10), ouster(10)};
  Session session(rig, withOtherClock("quarantine"));
  Arrivals arrivals = drive(rig, 3s);
  for (Arrival& a : arrivals)  // each one's clock steps against what the other one had
  {
    if (a.lidar == 0 && a.sent > kBegin + 1s) shiftStamps(a.packet, 37s);
    if (a.lidar == 1 && a.sent > kBegin + 2s) shiftStamps(a.packet, -900s);
  }
  for (const Arrival& a : arrivals) session.push(a.lidar, a.packet, a.received);
  session.take(session.batcher.finish());
  EXPECT_LT(session.scans.size(), 40u);
}

TEST(Findings, aQuarantinedLidarThatStartsAgainWhenNobodyElseIsHeardDoesNotLeadTheTime)
{
  const Rig rig{ouster(10), ouster(10)};
  Session session(rig, withOtherClock("quarantine"));
  for (Arrival& a : drive(rig, 8s))
  {
    if (a.lidar == 1 && a.sent > kBegin + 2s) continue;
    if (a.lidar == 0 && a.sent > kBegin + 1s) shiftStamps(a.packet, 3600s);
    if (a.lidar == 0 && a.sent > kBegin + 7s) store(a.packet, 0, std::uint32_t{7});  // init id
    session.push(a.lidar, a.packet, a.received);
  }
  session.take(session.batcher.finish());
  ASSERT_FALSE(session.scans.empty());
  EXPECT_LT(session.scans.back().start, kBegin + 10s);
  EXPECT_EQ(session.batcher.counters(0).restarts, 1u);
}

TEST(Findings, aLidarThatIsFirstHeardWhenAllOthersAreLeftOutDoesNotBeginAnotherTime)
{
  const Rig rig{ouster(10), ouster(10)};
  Session session(rig, withOtherClock("quarantine"));
  for (Arrival& a : drive(rig, 4s))
  {
    if (a.lidar == 1 && a.sent < kBegin + 3s) continue;
    if (a.lidar == 1) shiftStamps(a.packet, 7200s);
    if (a.lidar == 0 && a.sent > kBegin + 2s) shiftStamps(a.packet, 37s);
    session.push(a.lidar, a.packet, a.received);
  }
  session.take(session.batcher.finish());
  ASSERT_FALSE(session.scans.empty());
  EXPECT_LT(session.scans.back().start, kBegin + 10s);
}

TEST(Findings, aSliceHoldsNoBlockOfAnEarlierOne)
{
  const Rig rig{ouster(10), ouster(10)};
  Session session(rig, with(&BatcherOptions::slices, 4));
  session.batcher.onSlice(
      [](const ScanSlice& slice)
      {
        for (std::size_t i = slice.first_column; i < slice.end_column; ++i)
          EXPECT_TRUE(slice.scan.columns[i].stamp >= slice.begin() && slice.scan.columns[i].stamp < slice.end());
      });
  // Both lidars fall silent for half a scan; then one delivers what it had kept.
  for (Arrival& a : drive(rig, 1s))
  {
    const bool kept = a.sent > kBegin + 500ms && a.sent < kBegin + 550ms;
    if (kept) a.received = a.sent + 60ms;
    session.take(session.batcher.advance(a.received));
    session.push(a.lidar, a.packet, a.received);
  }
  session.take(session.batcher.finish());
  EXPECT_GT(session.batcher.counters(0).late, 0u);
}

TEST(Findings, aPacketWithoutIdsMaySpanAGapButNotHalfAnHour)
{
  std::vector<MeasurementBlock> blocks(12);
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    blocks[i].index = static_cast<std::uint16_t>(i);
    blocks[i].valid = true;
    blocks[i].stamp = Timestamp{1000s} + static_cast<int>(i) * 55us + (i < 9 ? Duration{0} : Duration{50ms});
  }
  std::vector<MeasurementBlock> damaged = blocks;
  EXPECT_EQ(keepAgreeing(blocks, Numbering::Stamps, 55us), 0u);
  damaged[4].stamp += 1800s;
  EXPECT_EQ(keepAgreeing(damaged, Numbering::Stamps, 55us), 1u);
  EXPECT_EQ(damaged.size(), 11u);
}

TEST(Findings, aStampThatIsFarFromTheHostsIsNotTurnedIntoOneNearby)
{
  FakeLidarOptions lidar;
  lidar.numbering = Numbering::Stamps;
  lidar.stamp_modulus = 3600s;
  const Rig rig{lidar};
  Session session(rig, {});
  std::vector<Arrival> arrivals = drive(rig, 1s);
  store(arrivals[20].packet, FakeLidar::kHeaderSize, std::numeric_limits<std::int64_t>::min());
  for (const Arrival& a : arrivals) session.push(a.lidar, a.packet, a.received);
  session.take(session.batcher.finish());
  EXPECT_EQ(session.batcher.counters(0).invalid, 1u);
  EXPECT_EQ(session.batcher.counters(0).implausible, 0u);
}
}  // namespace scanloom::findings_unittest
