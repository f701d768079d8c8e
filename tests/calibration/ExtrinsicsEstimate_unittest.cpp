/** Extrinsics of lidars from a drive among stems, compared with the poses and clocks by which the drive was made. */
#include "calibration/ExtrinsicsEstimate.h"

#include "calibration/ExtrinsicsReport.h"
#include "calibration/ExtrinsicsSearch.h"
#include "calibration/FieldOfViewOverlap.h"
#include "calibration/driveOfTwo.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace scanloom::extrinsics_estimate_unittest
{
namespace
{
constexpr double kLate = 0.02;  // s

/** Only what is on the body's side of `forward` (1 or -1). */
void look(int forward, const Rigid& body_T_sensor, std::vector<LidarScan>& scans)
{
  for (LidarScan& scan : scans)
  {
    const auto isBehind = [&](const Eigen::Vector3f& p)
    { return forward * (body_T_sensor.rotation * p.cast<double>()).x() < 0; };
    scan.points.erase(std::remove_if(scan.points.begin(), scan.points.end(), isBehind), scan.points.end());
    scan.t.resize(scan.points.size());
  }
}

ExtrinsicsEstimate calibrated(const DriveOfTwo& drive, const Rigid& given, Clock clock, PoseGiven known,
                              const Surroundings& around = {5}, const RotationByImus& imus = {})
{
  const std::vector<Station> stations = stationsOf(drive.right, drive.left, {kLeft, 0}, drive.trajectory, around);
  const ExtrinsicsStart start =
      findStart(stations, known == PoseGiven::No ? std::nullopt : std::optional(Extrinsics{given, 0}), drive.right,
                drive.left, kLeft, drive.trajectory, imus);
  return estimateExtrinsics(stations, {given, 0}, start, drive.trajectory, clock, imus);
}

void expectRight(const ExtrinsicsEstimate& estimate)
{
  ASSERT_TRUE(trusted(estimate)) << inWords("right", "left", estimate);
  EXPECT_LT((estimate.extrinsics.body_T_sensor.translation - kRight.translation).norm(), 0.015);
  EXPECT_LT(estimate.extrinsics.body_T_sensor.rotation.angularDistance(kRight.rotation) / kDegree, 0.1);
}
}  // namespace

TEST(ExtrinsicsEstimate, ofALidarThreeDegreesAndTenCentimetresOffIsItsPose)
{
  const ExtrinsicsEstimate estimate =
      calibrated(driven(1), at(1.55, -1.12, 2.45, -32, 16.5, 26.5), Clock::Kept, PoseGiven::Within20Degrees);
  expectRight(estimate);
  EXPECT_GT(estimate.shared_after, estimate.shared_before);
  EXPECT_LT(estimate.distance_after, estimate.distance_before);
}

TEST(ExtrinsicsEstimate, ofALidarTwentyDegreesAndHalfAMetreOffIsItsPose)
{
  expectRight(calibrated(driven(1), at(1.8, -0.9, 2.2, -46, 23, 33), Clock::Kept, PoseGiven::Within20Degrees));
}

TEST(ExtrinsicsEstimate, ofALidarWithoutAPoseIsItsPose)
{
  expectRight(calibrated(driven(1), Rigid::identity(), Clock::Kept, PoseGiven::No));
}

TEST(ExtrinsicsEstimate, ofLidarsThatLookForwardAndBackIsTheirPoseByTheDrive)
{
  DriveOfTwo drive = driven(1);
  look(1, kLeft, drive.left);
  look(-1, kRight, drive.right);
  const Rigid given = at(1.55, -1.12, 2.45, -32, 16.5, 26.5);
  const ExtrinsicsEstimate estimate =
      calibrated(drive, given, Clock::Kept, PoseGiven::Within20Degrees, {7, Stems::OnAxes});
  ASSERT_TRUE(trusted(estimate)) << inWords("right", "left", estimate);
  EXPECT_LT((estimate.extrinsics.body_T_sensor.translation - kRight.translation).norm(), 0.03);
  EXPECT_LT(estimate.extrinsics.body_T_sensor.rotation.angularDistance(kRight.rotation) / kDegree, 0.2);
}

TEST(FieldOfViewOverlap, isWhereBothLidarsLook)
{
  const Surroundings at_once{0};
  DriveOfTwo drive = driven(1);
  const auto shareOf = [&]
  {
    const std::vector<Station> stations = stationsOf(drive.right, drive.left, {kLeft, 0}, drive.trajectory, at_once);
    return commonField(stations, {kRight, 0}, drive.trajectory);
  };
  EXPECT_GT(shareOf(), 0.5);
  look(1, kLeft, drive.left);
  EXPECT_NEAR(shareOf(), 0.5, 0.1);
  look(-1, kRight, drive.right);
  EXPECT_LT(shareOf(), 0.2);
}

TEST(ExtrinsicsEstimate, isDoubtedByTheDistanceToAnotherOne)
{
  ExtrinsicsEstimate estimate;
  estimate.outcome = ExtrinsicsOutcome::Estimated;
  estimate.extrinsics.body_T_sensor = kRight;
  estimate.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-8, 1e-8, 1e-8, 0;
  const Extrinsics given{at(1.6, -1.2, 2.5, -30, 15, 25), 0};
  const auto by = [&](double x) { return doubted(estimate, {at(x, -1.2, 2.5, -30, 15, 25), 0}, given); };

  const ExtrinsicsEstimate near = by(1.52), far = by(1.54);
  EXPECT_EQ(near.outcome, ExtrinsicsOutcome::Estimated);
  EXPECT_NEAR(near.covariance(0, 0), 1e-6 + 0.02 * 0.02, 1e-12);
  EXPECT_NEAR(near.covariance(1, 1), 1e-6, 1e-12);
  EXPECT_EQ(near.extrinsics.body_T_sensor.translation.x(), 1.5);
  EXPECT_EQ(far.outcome, ExtrinsicsOutcome::Open);
  EXPECT_NEAR(far.extrinsics.body_T_sensor.translation.x(), 1.6, 1e-12);
}

TEST(ExtrinsicsSearch, keepsTheGivenPoseRatherThanOneAMetreOff)
{
  DriveOfTwo drive = driven(1);
  look(1, kLeft, drive.left);
  look(-1, kRight, drive.right);
  const std::vector<Station> stations = stationsOf(drive.right, drive.left, {kLeft, 0}, drive.trajectory, {7});
  const Extrinsics start =
      findStart(stations, Extrinsics{kRight, 0}, drive.right, drive.left, kLeft, drive.trajectory, {}).extrinsics;
  EXPECT_LT((start.body_T_sensor.translation - kRight.translation).norm(), 1);
}

TEST(StationMaps, leaveThickCellsOfBothLidarsOut)
{
  View view;
  for (int i = 0; i < 100; ++i)
  {
    const auto across = 0.01F * static_cast<float>(i);
    view.points.emplace_back(across, 0.01F * static_cast<float>(37 * i % 100), 0.5F);  // thin
    view.points.emplace_back(across, 0.01F * static_cast<float>(37 * i % 100),
                             2 + 0.01F * static_cast<float>(61 * i % 100));
  }
  const LidarScan scan{Timestamp{}, Duration{0}, view.points, std::vector<std::int32_t>(view.points.size(), 0)};
  const Trajectory at_rest{{Timestamp{-100ms}, {}}, {Timestamp{100ms}, {}}};
  const std::vector<Station> stations{{Timestamp{}, {&scan}, {view}, Vector6d::Zero()}};
  ExtrinsicsLevel level{1.0, 1.0};
  EXPECT_EQ(mapsOfReference(stations, level)[0].cells().size(), 2u);
  level.thickest = 0.1;
  EXPECT_EQ(mapsOfReference(stations, level)[0].cells().size(), 1u);
  EXPECT_EQ(cellsOfLidar(stations, {}, at_rest, level)[0].size(), 1u);
}

TEST(ExtrinsicsEstimate, findsHowLateALidarsStampsAre)
{
  const ExtrinsicsEstimate estimate =
      calibrated(driven(1, kLate), kRight, Clock::Estimated, PoseGiven::Within20Degrees);
  expectRight(estimate);
  const double sigma = std::sqrt(estimate.covariance(6, 6));
  EXPECT_LT(sigma, 0.005);
  EXPECT_NEAR(estimate.extrinsics.clock_offset, kLate, std::min(0.003, 3 * sigma));
}

TEST(ObservableExtrinsics, judgesAClockByItselfHoweverItGoesWithThePose)
{
  constexpr double kX = 0.02, kClock = 0.006, kCorrelation = 0.99;
  const Extrinsics given{kRight, 0}, estimate{at(1.52, -1.2, 2.5, -30, 15, 25), 0.03};
  Matrix7d covariance = 1e-6 * Matrix7d::Identity();
  covariance(0, 0) = kX * kX, covariance(6, 6) = kClock * kClock;
  covariance(0, 6) = covariance(6, 0) = kCorrelation * kX * kClock;

  const ObservableExtrinsics told = observableExtrinsics(given, estimate, covariance, kOpenLidar);
  ASSERT_EQ(told.open.size(), 1u);
  EXPECT_TRUE(told.open[0].isClock());
  EXPECT_NEAR(told.open[0].sigma, kClock, 1e-12);
  EXPECT_EQ(told.extrinsics.clock_offset, 0);
  EXPECT_NEAR(told.extrinsics.body_T_sensor.translation.x(), 1.52, 1e-12);
}

TEST(ExtrinsicsEstimate, ofAMachineThatStandsStillIsNone)
{
  const Rigid given = at(1.5, -1.1, 2.5, -31, 15, 25);
  const ExtrinsicsEstimate estimate = calibrated(driven(0), given, Clock::Kept, PoseGiven::Within20Degrees);
  EXPECT_EQ(estimate.outcome, ExtrinsicsOutcome::StoodStill);
  EXPECT_FALSE(trusted(estimate));
  EXPECT_EQ(estimate.extrinsics.body_T_sensor.translation, given.translation);
  EXPECT_NE(inWords("right", "left", estimate).find("drive 10 m or more"), std::string::npos);
}

TEST(ExtrinsicsEstimate, ofACoveredLidarIsNone)
{
  DriveOfTwo drive = driven(1);
  for (LidarScan& scan : drive.right)
    for (Eigen::Vector3f& p : scan.points) p = 0.8F * p.normalized();
  EXPECT_FALSE(trusted(calibrated(drive, kRight, Clock::Kept, PoseGiven::Within20Degrees)));
}

TEST(LidarScans, areInTheFramesOfTheLidars)
{
  Scan scan;
  scan.period = 100ms;
  scan.points.resize(2);
  scan.points.x[0] = 2, scan.points.x[1] = 3;
  scan.points.sensor_id[1] = 1;
  scan.columns.resize(2);
  scan.columns[0].count = scan.columns[1].count = 1;
  scan.columns[1].first_point = 1;
  scan.columns[1].sensor_id = 1;
  LidarScans scans(std::vector<MountedLidar>{{"left", at(1, 0, 0)}, {"right", at(0, 0, 1)}});
  scans.add(scan);
  ASSERT_EQ(scans.byLidar()[0].size(), 1u);
  EXPECT_EQ(scans.byLidar()[0][0].points, std::vector<Eigen::Vector3f>({{1, 0, 0}}));
  EXPECT_EQ(scans.byLidar()[1][0].points, std::vector<Eigen::Vector3f>({{3, 0, -1}}));
}

TEST(LidarScans, areNeverMoreThanMemoryHolds)
{
  Scan scan;
  scan.period = 100ms;
  scan.points.resize(1);
  scan.columns.resize(1);
  scan.columns[0].count = 1;
  LidarScans scans(std::vector<MountedLidar>{{"left", Rigid::identity()}});
  for (int i = 0; i < 5000; ++i, scan.start += scan.period) scans.add(scan);
  EXPECT_LE(scans.byLidar()[0].size(), 601u);
  EXPECT_GE(scans.byLidar()[0].size(), 300u);
}
}  // namespace scanloom::extrinsics_estimate_unittest
