#include "input/rig/withColumns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace scanloom::withcolumns_unittest
{
namespace
{
struct TimedPoint
{
  std::int32_t t;
  std::uint8_t lidar;
};

Scan scanOf(const std::vector<TimedPoint>& points)
{
  Scan scan;
  scan.start = Timestamp{1s};
  scan.period = 100ms;
  scan.points.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    scan.points.t[i] = points[i].t;
    scan.points.sensor_id[i] = points[i].lidar;
  }
  return withColumns(std::move(scan));
}

std::vector<std::uint16_t> countsOf(const Scan& scan)
{
  std::vector<std::uint16_t> counts;
  for (const Column& column : scan.columns) counts.push_back(column.count);
  return counts;
}
}  // namespace

TEST(WithColumns, makesAColumnOfNeighboursWithOneTime)
{
  const Scan scan = scanOf({{10, 0}, {10, 0}, {20, 0}});
  EXPECT_THAT(countsOf(scan), testing::ElementsAre(2, 1));
  EXPECT_EQ(scan.columns[1].stamp, scan.start + Duration{20});
  EXPECT_EQ(scan.columns[1].first_point, 2U);
}

TEST(WithColumns, separatesLidarsOfOneTime)
{
  const Scan scan = scanOf({{10, 0}, {10, 2}, {10, 2}});
  EXPECT_THAT(countsOf(scan), testing::ElementsAre(1, 2));
  EXPECT_EQ(scan.columns[1].sensor_id, 2);
  EXPECT_THAT(scan.columns_of, testing::ElementsAre(1, 0, 1));
}

TEST(WithColumns, givesPointsTheNumberOfTheirColumn)
{
  const Scan scan = scanOf({{10, 0}, {20, 0}, {20, 0}});
  EXPECT_THAT(scan.points.column, testing::ElementsAre(0, 1, 1));
}

TEST(WithColumns, splitsWhatAColumnCannotCount)
{
  const Scan scan = scanOf(std::vector<TimedPoint>(70'000, {10, 0}));
  EXPECT_THAT(countsOf(scan), testing::ElementsAre(65'535, 4'465));
}

TEST(WithColumns, leavesAScanWithoutPointsWithoutColumns)
{
  const Scan scan = scanOf({});
  EXPECT_TRUE(scan.columns.empty());
  EXPECT_THAT(scan.columns_of, testing::ElementsAre(0));
}
}  // namespace scanloom::withcolumns_unittest
