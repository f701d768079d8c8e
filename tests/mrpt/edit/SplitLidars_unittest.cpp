/** Clouds of several lidars apart, together again, and one lidar alone. */
#include "mrpt/edit/internal/SplitLidars.h"

#include "base/core/ConfigError.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/RawlogHeader.h"
#include "mrpt/edit/internal/KeepLidars.h"
#include "mrpt/edit/internal/MergeLidars.h"
#include "mrpt/observations/Observations.h"
#include "mrpt/observations/RawlogInfo.h"
#include "smallRawlog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanloom::split_lidars_unittest
{
namespace
{
using mrpt::maps::CGenericPointsMap;
using testing::ElementsAre;

struct SplitLidars : testing::Test
{
  TemporaryFolder folder;
  std::filesystem::path in = writeSmallRawlog(folder / "in.rawlog");
  std::filesystem::path split = folder / "split.rawlog";
  std::filesystem::path merged = folder / "merged.rawlog";

  /** Apart and together again. */
  void turnRound()
  {
    edited(in, splitLidars(someHeader()), split);
    edited(split, mergeLidars(someHeader()), merged);
  }

  std::vector<double> orderOf(const std::string& label) const
  {
    const auto cloud = cloudIn(observationsIn(split, label).front());
    const auto* order = genericCloudOf(*cloud).getPointsBufferRef_double_field(kOrderField);
    return order ? std::vector<double>(order->begin(), order->end()) : std::vector<double>{};
  }

  void writeOneScan(const Scan& scan) const
  {
    RawlogWriter writer(in, someHeader());
    writer.write(*toObservation(scan));
    writer.close();
  }
};

TEST_F(SplitLidars, givesACloudPerScanAndLidarEvenIfEmpty)
{
  edited(in, splitLidars(someHeader()), split);

  for (const std::string label : {"lidar_left", "lidar_right"})
  {
    std::vector<std::size_t> sizes;
    for (const ObservationPtr& part : observationsIn(split, label)) sizes.push_back(cloudIn(part)->pointcloud->size());
    EXPECT_THAT(sizes, ElementsAre(60, 60, 60, 0)) << label;
  }
  EXPECT_TRUE(observationsIn(split, "lidar").empty());
  EXPECT_EQ(observationsIn(split, "imu").size(), 8u);
}

TEST_F(SplitLidars, partsHoldTheirLidarsPointsWithAllFields)
{
  edited(in, splitLidars(someHeader()), split);

  const auto part = cloudIn(observationsIn(split, "lidar_right").front());
  const CGenericPointsMap& points = genericCloudOf(*part);
  EXPECT_THAT(*points.getPointsBufferRef_uint8_field("sensor_id"), testing::Each(1));
  float x = 0, y = 0, z = 0;
  points.getPointFast(4, x, y, z);  // the second point of the lidar's second column, the rig's fourth
  EXPECT_FLOAT_EQ(x, 1.0f);
  EXPECT_FLOAT_EQ(y, -0.6f);
  EXPECT_FLOAT_EQ(z, 1.0f);
  EXPECT_EQ((*points.getPointsBufferRef_uint16_field("column"))[4], 1000 + 75 - 1024);
  EXPECT_FLOAT_EQ((*points.getPointsBufferRef_float_field("t"))[4], 0.007324209f);
}

TEST_F(SplitLidars, togetherAgainTheyAreTheSameBytes)
{
  turnRound();
  EXPECT_FALSE(uncompressed(split) == uncompressed(in));
  EXPECT_TRUE(uncompressed(merged) == uncompressed(in));
  EXPECT_TRUE(orderOf("lidar_left").empty()) << "times tell the order";
}

TEST_F(SplitLidars, stampsNearerThanFloatsCanTellKeepTheirOrder)
{
  Scan scan = someScan(kSmallStart);
  for (std::int32_t& t : scan.points.t) t = 90'000'000;  // one instant as a float, though lidars alternate
  writeOneScan(scan);

  turnRound();

  EXPECT_TRUE(uncompressed(merged) == uncompressed(in));
  EXPECT_THAT(orderOf("lidar_right"), testing::SizeIs(60));
  EXPECT_EQ(orderOf("lidar_right").front(), 3) << "after the three points of the left lidar's first column";
}

TEST_F(SplitLidars, pointsWithinAColumnThatGoBackInTimeKeepTheirOrder)
{
  Scan scan = someScan(kSmallStart);
  for (std::size_t i = 0; i < scan.points.size(); i += 3) std::swap(scan.points.t[i], scan.points.t[(i + 7) % 120]);
  writeOneScan(scan);
  turnRound();
  EXPECT_TRUE(uncompressed(merged) == uncompressed(in));
}

TEST_F(SplitLidars, optionsOfTheCloudsSurvive)
{
  const auto setOption = [](const ObservationPtr& observation) -> Observations
  {
    if (!observation) return {};
    if (const auto cloud = cloudIn(observation)) cloud->pointcloud->insertionOptions.minDistBetweenLaserPoints = 0.75f;
    return {observation};
  };
  edited(in, setOption, in);
  turnRound();
  EXPECT_TRUE(uncompressed(merged) == uncompressed(in));
  EXPECT_EQ(
      cloudIn(observationsIn(split, "lidar_left").front())->pointcloud->insertionOptions.minDistBetweenLaserPoints,
      0.75f);
}

TEST_F(SplitLidars, slicesStaySlices)
{
  RawlogWriter writer(in, someHeader());
  writer.write(*toObservation(someScan(kSmallStart), CloudClass::CGenericPointsMap, "lidar_slice"));
  writer.write(*toObservation(someScan(kSmallStart)));
  writer.close();
  turnRound();
  EXPECT_EQ(observationsIn(split, "lidar_left_slice").size(), 1u);
  EXPECT_TRUE(uncompressed(merged) == uncompressed(in));
}

TEST_F(SplitLidars, aScanWithoutAPartIsMergedFromTheOthers)
{
  edited(in, splitLidars(someHeader()), split);
  const auto loseOne = [lost = false](const ObservationPtr& observation) mutable -> Observations
  {
    if (!observation) return {};
    if (observation->sensorLabel == "lidar_right" && !std::exchange(lost, true)) return {};
    return {observation};
  };
  edited(split, loseOne, split);
  edited(split, mergeLidars(someHeader()), merged);

  std::vector<std::size_t> sizes;
  for (const ObservationPtr& scan : observationsIn(merged, "lidar")) sizes.push_back(cloudIn(scan)->pointcloud->size());
  EXPECT_THAT(sizes, ElementsAre(60, 120, 120, 0));
}

TEST_F(SplitLidars, aPointOfNoLidarIsAnError)
{
  RecordingHeader one = someHeader();
  one.lidars.pop_back();
  EXPECT_THROW(edited(in, splitLidars(one), split), std::invalid_argument);
}

TEST_F(SplitLidars, cloudsWithoutFieldsAreAnError)
{
  RawlogWriter writer(in, someHeader());
  writer.write(*toObservation(someScan(kSmallStart), CloudClass::CPointsMapXYZI));
  writer.close();
  EXPECT_THROW(edited(in, splitLidars(someHeader()), split), std::invalid_argument);
}

TEST_F(SplitLidars, theLongestNameThatFitsIsTheLidars)
{
  RecordingHeader header = someHeader();
  header.lidars[1].name = "front_left";
  EXPECT_EQ(partOf("lidar_front_left", header)->lidar, 1u);
  EXPECT_EQ(partOf("lidar_left", header)->lidar, 0u);
  EXPECT_FALSE(partOf("lidar", header));
}

TEST_F(SplitLidars, oneLidarAloneIsRenumberedAndTheHeaderNamesItAlone)
{
  edited(in, keepLidars({"right"}, someHeader()), merged);

  const RawlogInfo info = rawlogInfo(merged);
  ASSERT_EQ(info.header->lidars.size(), 1u);
  EXPECT_EQ(info.header->lidars[0].name, "right");
  EXPECT_EQ(info.points(), 180u) << "60 of each scan that is not empty";
  const auto scan = cloudIn(observationsIn(merged, "lidar").front());
  EXPECT_THAT(*genericCloudOf(*scan).getPointsBufferRef_uint8_field("sensor_id"), testing::Each(0));
  EXPECT_EQ(observationsIn(merged, "imu_right").size(), 4u);
}

TEST_F(SplitLidars, theImuWithinALidarThatGoesGoesToo)
{
  edited(in, keepLidars({"left"}, someHeader()), merged);
  EXPECT_TRUE(observationsIn(merged, "imu_right").empty());
  EXPECT_EQ(observationsIn(merged, "imu").size(), 8u);
}

TEST_F(SplitLidars, aNameThatNoLidarHasIsAMistake) { EXPECT_THROW(keepLidars({"centre"}, someHeader()), UsageError); }
}  // namespace
}  // namespace scanloom::split_lidars_unittest
