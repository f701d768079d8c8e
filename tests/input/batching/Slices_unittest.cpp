#include <gtest/gtest.h>

#include "FaultRig.h"
#include "support/pushPacket.h"
#include "support/with.h"

namespace scanloom::slices_unittest
{
namespace
{
struct Given
{
  Timestamp scan_start, begin, end;
  int index = 0;
  std::vector<Column> columns;  // those that the slice adds
  std::vector<Column> so_far;
  std::string digest_so_far;
};

struct Sliced
{
  std::vector<Scan> scans;
  std::vector<Given> slices;
};

Sliced slicesOf(const Rig& rig, const Arrivals& arrivals, const BatcherOptions& options)
{
  TimeBatcher batcher = batcherOf(rig, options);
  Sliced sliced;
  batcher.onSlice(
      [&sliced](const ScanSlice& s)
      {
        const auto column = [&s](std::size_t i) { return s.scan.columns.begin() + static_cast<std::ptrdiff_t>(i); };
        sliced.slices.push_back({s.scan.start,
                                 s.begin(),
                                 s.end(),
                                 s.index,
                                 {column(s.first_column), column(s.end_column)},
                                 {column(0), column(s.end_column)},
                                 digestOf({s.scan})});
      });
  const auto collect = [&sliced](std::vector<Scan> scans)
  {
    for (Scan& scan : scans) sliced.scans.push_back(std::move(scan));
  };
  for (const Arrival& a : arrivals) collect(push(batcher, a.lidar, a.packet, a.received));
  collect(batcher.finish());
  return sliced;
}
}  // namespace

TEST(Slices, areSubRangesOfTheScanAndTheLastOneIsTheScanToTheBit)
{
  const Rig rig = referenceRig();
  for (const int count : {1, 2, 7, 20})
  {
    const Sliced sliced = slicesOf(rig, drive(rig, 1s), with(&BatcherOptions::slices, count));
    ASSERT_EQ(sliced.slices.size(), sliced.scans.size() * static_cast<std::size_t>(count));
    for (std::size_t k = 0; k < sliced.scans.size(); ++k)
    {
      std::size_t columns = 0;
      for (int i = 0; i < count; ++i)
      {
        const Given& slice = sliced.slices[k * static_cast<std::size_t>(count) + static_cast<std::size_t>(i)];
        EXPECT_EQ(slice.index, i);
        EXPECT_EQ(slice.scan_start, sliced.scans[k].start);
        EXPECT_EQ(slice.so_far.size(), columns + slice.columns.size());
        for (const Column& c : slice.columns) EXPECT_TRUE(c.stamp >= slice.begin && c.stamp < slice.end);
        columns += slice.columns.size();
      }
      EXPECT_EQ(sliced.slices[(k + 1) * static_cast<std::size_t>(count) - 1].digest_so_far,
                digestOf({sliced.scans[k]}));
    }
  }
}

TEST(Slices, doNotChangeTheScans)
{
  const Rig rig = referenceRig();
  EXPECT_EQ(digestOf(slicesOf(rig, drive(rig, 1s), with(&BatcherOptions::slices, 8)).scans),
            digestOf(batch(rig, drive(rig, 1s)).scans));
}

TEST(Slices, asScansOfTheirOwnJoinToTheWhole)
{
  const Rig rig = referenceRig();
  TimeBatcher batcher = batcherOf(rig, with(&BatcherOptions::slices, 4));
  std::vector<Scan> parts, scans;
  batcher.onSlice([&parts](const ScanSlice& slice) { parts.push_back(copyOf(slice)); });
  for (const Arrival& a : drive(rig, 1s))
    for (Scan& scan : push(batcher, a.lidar, a.packet, a.received)) scans.push_back(std::move(scan));
  ASSERT_GE(parts.size(), 4 * scans.size());
  for (std::size_t k = 0; k < scans.size(); ++k)
  {
    std::size_t points = 0;
    for (std::size_t i = 4 * k; i < 4 * k + 4; ++i)
    {
      EXPECT_EQ(parts[i].period, 25ms);
      for (std::size_t p = 0; p < parts[i].points.size(); ++p, ++points)
      {
        ASSERT_EQ(parts[i].points.x[p], scans[k].points.x[points]);
        ASSERT_EQ(parts[i].start + Duration{parts[i].points.t[p]},
                  scans[k].start + Duration{scans[k].points.t[points]});
      }
    }
    EXPECT_EQ(points, scans[k].points.size());
  }
}

TEST(ScanRate, mayBeAnythingFromOneTo200HzAndTheScansAreCutFromTheSameColumns)
{
  const Rig rig = referenceRig();
  const Arrivals arrivals = drive(rig, 3s);
  for (const double rate : {1.0, 3.0, 7.5, 10.0, 29.97, 50.0, 100.0, 200.0})
  {
    const Outcome outcome = batch(rig, arrivals, with(&BatcherOptions::scan_rate, rate));
    for (std::size_t k = 0; k + 1 < outcome.scans.size(); ++k)
    {
      EXPECT_NEAR(seconds(outcome.scans[k].period), 1 / rate, 1e-9);
      if (outcome.scans[k].end() > arrivals.back().sent - 20ms) continue;  // cut by the end of input
      EXPECT_TRUE(outcome.scans[k].complete());
      EXPECT_LE(outcome.released[k] - outcome.scans[k].end(), kPacketTime + 1ms);
    }
  }
}
}  // namespace scanloom::slices_unittest
