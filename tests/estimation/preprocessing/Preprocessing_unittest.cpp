#include <gtest/gtest.h>

#include "base/core/ConfigError.h"
#include "estimation/preprocessing/Crop.h"
#include "estimation/preprocessing/Deskew.h"
#include "estimation/preprocessing/Thin.h"
#include "support/messageOf.h"
#include "support/with.h"

namespace scanloom::preprocessing_unittest
{
namespace
{
/** One point per column, at these places. */
Scan scanOf(const std::vector<Eigen::Vector3f>& positions)
{
  Scan scan;
  scan.period = 100ms;
  scan.points.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    scan.points.x[i] = positions[i].x();
    scan.points.y[i] = positions[i].y();
    scan.points.z[i] = positions[i].z();
    scan.points.range[i] = positions[i].allFinite() ? static_cast<std::uint32_t>(1000 * positions[i].norm()) : 0;
    Column column;
    column.stamp = Timestamp{Duration{static_cast<std::int64_t>(i)} * 1000000};
    column.first_point = static_cast<std::uint32_t>(i);
    column.count = 1;
    scan.columns.push_back(column);
  }
  return scan;
}
}  // namespace

TEST(Crop, removesTheMachineAndLeavesItsColumnsInPlace)
{
  CropOptions box;
  box.min_x = box.min_y = box.min_z = -1;
  box.max_x = box.max_y = box.max_z = 1;
  const Scan cropped = cropOut(scanOf({{5, 0, 0}, {0.9f, 0.9f, -0.9f}, {0, 1.1f, 0}}), cropOf(box)).scan;
  ASSERT_EQ(cropped.points.size(), 2u);
  EXPECT_EQ(cropped.points.y[1], 1.1f);
  ASSERT_EQ(cropped.columns.size(), 3u);
  EXPECT_EQ(cropped.columns[1].count, 0);
  EXPECT_EQ(cropped.columns[2].first_point, 1u);
}

TEST(Crop, removesWhatIsTooFarOrNotFinite)
{
  CropOptions options;
  options.max_range = 50;
  EXPECT_EQ(cropOut(scanOf({{60, 0, 0}, {40, 0, 0}, {NAN, 0, 10}}), cropOf(options)).scan.points.size(), 1u);
}

TEST(Crop, countsEveryPointOnceByLidarAndByWhatRemovedIt)
{
  CropOptions options;  // machine from -4 to 10, -3 to 3 and -0.5 to 6
  options.min_range = 15;
  options.max_range = 50;
  Scan scan = scanOf({{0, 0, 0}, {NAN, 0, 10}, {60, 0, 0}, {40, 0, 0}, {0, 10, 0}, {41, 0, 0}});
  scan.columns[5].sensor_id = 1;
  scan.points.sensor_id[5] = 1;

  const std::vector<CropCounts> counts = cropOut(scan, cropOf(options)).counts;

  ASSERT_EQ(counts.size(), 2u);
  EXPECT_EQ(counts[0].machine, 1u);
  EXPECT_EQ(counts[0].not_finite, 1u);
  EXPECT_EQ(counts[0].too_far, 1u);
  EXPECT_EQ(counts[0].too_near, 1u);
  EXPECT_EQ(counts[0].kept, 1u);
  EXPECT_EQ(counts[0].all(), 5u);
  EXPECT_EQ(counts[1].kept, 1u);
}

TEST(Crop, removesFromEachLidarWhatIsInItsOwnBoxAndLeavesItToTheOthers)
{
  // The right lidar is 20 m ahead of the body and turned by 90 deg: its x is the body's y.
  const std::vector<MountedLidar> lidars{{"left", Rigid::identity()},
                                         {"right", Rigid::fromXyzYawPitchRoll(20, 0, 0, M_PI / 2, 0, 0)}};
  Scan scan = scanOf({{20, 5, 0}, {20, 5, 0}, {15, 0, 0}});
  for (const std::size_t i : {1, 2}) scan.columns[i].sensor_id = scan.points.sensor_id[i] = 1;

  const CroppedScan cropped = cropOut(scan, cropOf(with(&CropOptions::lidar_boxes, "right 4 -1 -1 6 1 1"), lidars));

  EXPECT_EQ(cropped.scan.points.size(), 2u);
  EXPECT_EQ(cropped.counts[0].kept, 1u);
  EXPECT_EQ(cropped.counts[1].lidar_box, 1u);
  EXPECT_EQ(cropped.counts[1].kept, 1u);
}

TEST(LidarBox, isRefusedWithItsNameIfItIsNoneOrOfNoLidar)
{
  const std::vector<MountedLidar> lidars{{"left", Rigid::identity()}};
  const auto refusalOf = [&](const char* text) { return messageOf<ConfigError>([&] { lidarBoxes(text, lidars); }); };
  EXPECT_NE(refusalOf("left 0 0 0 1 1 -1").find("'left 0 0 0 1 1 -1': must be NAME x0"), std::string::npos);
  EXPECT_NE(refusalOf("left 0 0 0 1 1").find("must be NAME x0"), std::string::npos);
  EXPECT_NE(refusalOf("left 0 0 0 1 1 x").find("must be NAME x0"), std::string::npos);
  EXPECT_NE(refusalOf("lfet 0 0 0 1 1 1").find("no lidar is called 'lfet'"), std::string::npos);
  EXPECT_EQ(refusalOf("left 0 0 0 1 1 1, left 2 2 2 3 3 3"), "");
  EXPECT_EQ(refusalOf(""), "");
}

TEST(Deskew, aWallSeenWhileDrivingTowardsItBecomesFlat)
{
  // 1 m/s along x, a wall at x = 10 of the scan's end: at t before the end it is seen 1 m/s * t farther away.
  std::vector<Eigen::Vector3f> seen;
  std::vector<Rigid> end_T_column;
  for (int i = 0; i < 100; ++i)
  {
    const double before_end = 0.1 - 0.001 * i;
    seen.emplace_back(static_cast<float>(10 + before_end), static_cast<float>(i), 0.f);
    end_T_column.push_back({Eigen::Quaterniond::Identity(), {-before_end, 0, 0}});
  }
  const PointCloud points = deskew(scanOf(seen), end_T_column);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(points.x[i], 10, 2e-6);
}

TEST(Deskew, wantsOnePosePerColumn) { EXPECT_THROW(deskew(scanOf({{1, 0, 0}}), {}), std::invalid_argument); }

TEST(Thin, keepsTheFirstPointOfEachCube)
{
  const PointCloud points = thin(scanOf({{0.01f, 0, 0}, {0.09f, 0, 0}, {-0.01f, 0, 0}, {0.11f, 0, 0}}).points, 0.1);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points.x, (std::vector<float>{0.01f, -0.01f, 0.11f}));
}
}  // namespace scanloom::preprocessing_unittest
