#include "lab/whole_turns/WholeTurns.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace scanloom::whole_turns_unittest
{
namespace
{
struct TurningLidar
{
  Duration phase{0};  // its first turn begins so much after 0
  Duration turn = 100ms;
  Duration length = 1s;  // silent after it
};

constexpr int kColumns = 64;  // of a turn, with one point each

/** Scans of 100 ms with the columns of all lidars; a point's x is its stamp in ms. */
std::vector<Scan> scansByTime(const std::vector<TurningLidar>& lidars, Timestamp begin = Timestamp{})
{
  std::vector<Column> columns;
  for (std::size_t i = 0; i < lidars.size(); ++i)
    for (int k = 0; k * lidars[i].turn / kColumns < lidars[i].length; ++k)
    {
      Column column;
      column.stamp = Timestamp{lidars[i].phase + k * lidars[i].turn / kColumns};
      column.count = 1;
      column.measurement_id = static_cast<std::uint16_t>(k % kColumns);
      column.frame_id = static_cast<std::uint32_t>(k / kColumns);
      column.sensor_id = static_cast<std::uint8_t>(i);
      if (column.stamp >= begin) columns.push_back(column);
    }
  std::stable_sort(columns.begin(), columns.end(), [](const auto& a, const auto& b) { return a.stamp < b.stamp; });

  std::vector<Scan> scans;
  for (Column column : columns)
  {
    const Timestamp start{column.stamp.time_since_epoch() / 100ms * 100ms};
    if (scans.empty() || scans.back().start != start) scans.push_back({start, 100ms, {}, {}, {}, {}});
    Scan& scan = scans.back();
    column.first_point = static_cast<std::uint32_t>(scan.points.size());
    scan.columns.push_back(column);
    scan.points.resize(scan.points.size() + 1);
    scan.points.x[column.first_point] = static_cast<float>(1e3 * seconds(column.stamp.time_since_epoch()));
    scan.points.t[column.first_point] = static_cast<std::int32_t>((column.stamp - start).count());
    scan.points.sensor_id[column.first_point] = column.sensor_id;
  }
  return scans;
}

std::vector<Scan> turnsOf(const std::vector<Scan>& by_time, std::size_t lidars,
                          TurnGrouping grouping = TurnGrouping::Nearest)
{
  WholeTurns turns(lidars, grouping);
  std::vector<Scan> scans;
  for (const Scan& scan : by_time)
    for (Scan& of_turns : turns.push(scan)) scans.push_back(std::move(of_turns));
  for (Scan& of_turns : turns.finish()) scans.push_back(std::move(of_turns));
  return scans;
}

Timestamp firstStampOf(const Scan& scan, std::uint8_t sensor)
{
  const auto column = std::find_if(scan.columns.begin(), scan.columns.end(),
                                   [sensor](const Column& c) { return c.sensor_id == sensor; });
  return column == scan.columns.end() ? Timestamp::max() : column->stamp;
}
}  // namespace

TEST(WholeTurns, aScanOfOneLidarIsFromTheEncodersZeroToTheNext)
{
  const auto scans = turnsOf(scansByTime({{30ms}}), 1);

  ASSERT_EQ(scans.size(), 10u);
  for (const Scan& scan : scans)
  {
    EXPECT_EQ(scan.columns.size(), 64u);
    EXPECT_EQ(scan.columns.front().measurement_id, 0);
    EXPECT_EQ(scan.start, scan.columns.front().stamp);
    EXPECT_EQ(scan.end(), scan.columns.back().stamp + 1ns);
    EXPECT_TRUE(scan.complete());
  }
}

TEST(WholeTurns, nearestTurnsSpanOneAndAHalfTurnsInTheWorstPhase)
{
  const auto scans = turnsOf(scansByTime({{0ms}, {50ms}}), 2);
  EXPECT_NEAR(seconds(scans[1].period), 0.15, 0.1 / kColumns);  // the paper, section 1.1
}

TEST(WholeTurns, theNearestTurnMayBeTheOneBeforeOrTheOneAfter)
{
  const auto before = turnsOf(scansByTime({{0ms}, {70ms}}), 2), after = turnsOf(scansByTime({{0ms}, {30ms}}), 2);

  EXPECT_EQ(firstStampOf(before[1], 0), Timestamp{100ms});
  EXPECT_EQ(firstStampOf(before[1], 1), Timestamp{70ms});
  EXPECT_EQ(firstStampOf(after[1], 0), Timestamp{100ms});
  EXPECT_EQ(firstStampOf(after[1], 1), Timestamp{130ms});
}

TEST(WholeTurns, oneOfEachMeetsAsTheLidarsBegan)
{
  const auto scans = turnsOf(scansByTime({{0ms}, {70ms}}), 2, TurnGrouping::OneOfEach);

  EXPECT_EQ(firstStampOf(scans[1], 0), Timestamp{100ms});
  EXPECT_EQ(firstStampOf(scans[1], 1), Timestamp{170ms});
}

TEST(WholeTurns, columnsAreInTimeOrderAndEveryPointHasItsOwnTime)
{
  const Scan scan = turnsOf(scansByTime({{0ms}, {30ms}}), 2)[1];

  EXPECT_EQ(scan.columns_of, (std::vector<std::uint32_t>{64, 64}));
  std::uint32_t next = 0;
  Timestamp before = scan.start;
  for (const Column& column : scan.columns)
  {
    EXPECT_EQ(column.first_point, next);
    EXPECT_GE(column.stamp, before);
    before = column.stamp;
    next += column.count;
    EXPECT_EQ(scan.start + Duration{scan.points.t[column.first_point]}, column.stamp);
    EXPECT_EQ(scan.points.sensor_id[column.first_point], column.sensor_id);
    EXPECT_FLOAT_EQ(scan.points.x[column.first_point],
                    static_cast<float>(1e3 * seconds(column.stamp.time_since_epoch())));
  }
  EXPECT_EQ(next, scan.points.size());
}

TEST(WholeTurns, aFirstTurnWithoutItsBeginningIsLeftOut)
{
  const auto scans = turnsOf(scansByTime({{30ms}}, Timestamp{100ms}), 1);
  EXPECT_EQ(scans.front().start, Timestamp{130ms});
}

TEST(WholeTurns, aSilentLidarLeavesIncompleteScans)
{
  for (const TurnGrouping grouping : {TurnGrouping::Nearest, TurnGrouping::OneOfEach})
  {
    const auto scans = turnsOf(scansByTime({{0ms}, {30ms, 100ms, 300ms}}), 2, grouping);

    EXPECT_EQ(scans.size(), 10u);
    EXPECT_FALSE(scans[6].complete());
    EXPECT_EQ(scans[6].columns_of, (std::vector<std::uint32_t>{64, 0}));
  }
}

TEST(WholeTurns, everySecondTurnOfALidarTwiceAsFastIsDropped)
{
  std::uint32_t fast = 0;
  for (const Scan& scan : turnsOf(scansByTime({{0ms}, {10ms, 50ms}}), 2)) fast += scan.columns_of[1];
  EXPECT_EQ(fast, 10u * 64);
}

TEST(WholeTurns, anUnknownGroupingIsNamedWithTheOnesThatThereAre)
{
  EXPECT_EQ(turnGroupingFromName("one_of_each"), TurnGrouping::OneOfEach);
  EXPECT_THROW(turnGroupingFromName("nearest_turns"), std::invalid_argument);
}
}  // namespace scanloom::whole_turns_unittest
