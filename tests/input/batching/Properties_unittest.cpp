// Properties of batching over random drives: any rates, phases, windows, losses and arrival orders within the deadline.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <tuple>

#include "FaultRig.h"

namespace scanloom::properties_unittest
{
namespace
{
struct Drive
{
  Rig lidars;
  Arrivals arrivals;
  BatcherOptions options;
};

FakeLidarOptions anyLidar()
{
  FakeLidarOptions lidar;
  lidar.columns_per_packet = *rc::gen::element(4, 8, 16);
  lidar.columns_per_frame = lidar.columns_per_packet * *rc::gen::inRange(4, 12);
  lidar.frame_rate = *rc::gen::element(5.0, 10.0, 20.0, 9.97);
  lidar.first_column = *rc::gen::inRange(0, lidar.columns_per_frame);
  lidar.last_column = *rc::gen::inRange(0, lidar.columns_per_frame);
  return lidar;
}

/** From a packet's last block to its arrival: well within the deadline of 5 ms. */
Duration anyDelay() { return Duration{*rc::gen::inRange<std::int64_t>(100000, 2000000)}; }

Drive anyDrive()
{
  Drive drive;
  drive.options.scan_rate = *rc::gen::element(5.0, 10.0, 25.0);
  const auto count = *rc::gen::inRange<std::size_t>(1, 5);
  for (LidarIndex i = 0; i < count; ++i)
  {
    drive.lidars.push_back(anyLidar());
    const Timestamp first{Duration{*rc::gen::inRange<std::int64_t>(1000000000, 1090000000)}};
    for (auto& packet : FakeLidar(drive.lidars.back()).drive(first, 700ms, *rc::gen::element(0u, 65533u)))
    {
      const Timestamp sent = lastStampOf(packet);
      drive.arrivals.push_back({i, std::move(packet), sent + anyDelay(), sent});
    }
  }
  return drive;
}

/** Only packets tell the time. Also expects what must hold whatever happens. */
Outcome batch(const Drive& drive, Arrivals arrivals)
{
  inOrderOfArrival(arrivals);
  return scanloom::batch(drive.lidars, arrivals, drive.options, Clock::Replay);
}

using BlockKey = std::tuple<Timestamp, std::uint8_t, std::uint16_t>;

std::vector<BlockKey> keysOf(const std::vector<Scan>& scans)
{
  std::vector<BlockKey> keys;
  for (const Scan& scan : scans)
    for (const Column& column : scan.columns) keys.emplace_back(column.stamp, column.sensor_id, column.measurement_id);
  return keys;
}

/** What the arrivals hold from `start` on, by the definition of the order: sort everything. */
std::vector<BlockKey> sortedBlocks(const Drive& drive, Timestamp start)
{
  std::vector<BlockKey> keys;
  std::vector<MeasurementBlock> blocks;
  for (const Arrival& a : drive.arrivals)
  {
    FakeLidar(drive.lidars[a.lidar]).readBlocks(a.packet, blocks);
    for (const auto& b : blocks)
      if (b.valid && b.stamp >= start) keys.emplace_back(b.stamp, static_cast<std::uint8_t>(a.lidar), b.measurement_id);
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

bool sameBits(const Scan& l, const Scan& r)
{
  return l.start == r.start && l.points.x == r.points.x && l.points.t == r.points.t &&
         l.points.column == r.points.column && l.points.sensor_id == r.points.sensor_id &&
         l.points.ring == r.points.ring && l.columns_of == r.columns_of && l.missing == r.missing;
}

#define CHECK_PROPERTY(...) EXPECT_TRUE(rc::check(__VA_ARGS__))
}  // namespace

TEST(BatchingProperties, everyBlockComesOutOnceInTheTotalOrder)
{
  CHECK_PROPERTY("emitted = sorted input from the first scan's start on",
                 []
                 {
                   const Drive drive = anyDrive();
                   const auto scans = batch(drive, drive.arrivals).scans;
                   if (scans.empty()) return;
                   RC_ASSERT(keysOf(scans) == sortedBlocks(drive, scans.front().start));
                 });
}

TEST(BatchingProperties, anyInterleavingGivesTheSameScansToTheBit)
{
  CHECK_PROPERTY("arrival times within the deadline do not matter",
                 []
                 {
                   const Drive drive = anyDrive();
                   auto shuffled = drive.arrivals;
                   for (Arrival& a : shuffled) a.received = a.sent + anyDelay();
                   const auto scans = batch(drive, drive.arrivals).scans, again = batch(drive, shuffled).scans;
                   RC_ASSERT(scans.size() == again.size());
                   for (std::size_t k = 0; k < scans.size(); ++k) RC_ASSERT(sameBits(scans[k], again[k]));
                 });
}

TEST(BatchingProperties, accountsCloseUnderLossAndDuplication)
{
  CHECK_PROPERTY("received = sum of all counts; nothing received in time is lost",
                 []
                 {
                   Drive drive = anyDrive();
                   Arrivals arrivals;
                   for (const Arrival& a : drive.arrivals)
                   {
                     const int copies = *rc::gen::weightedElement<int>({{16, 1}, {2, 0}, {2, 2}});
                     for (int i = 0; i < copies; ++i) arrivals.push_back(a);
                   }
                   const Outcome outcome = batch(drive, arrivals);
                   std::uint64_t emitted = 0;
                   for (const LidarCounters& c : outcome.counters)
                   {
                     RC_ASSERT(c.received == c.emitted + c.late + c.duplicate + c.invalid + c.before_start +
                                                 c.implausible + c.dropped);
                     RC_ASSERT(c.late == 0u && c.dropped == 0u && c.implausible == 0u);
                     emitted += c.emitted;
                   }
                   RC_ASSERT(keysOf(outcome.scans).size() == emitted);
                 });
}
}  // namespace scanloom::properties_unittest
