/** The IMU's extrinsics from a drive in closed form: noisy poses by a lidar in a map that is not level, noisy readings.
 */
#include "calibration/ImuExtrinsicsEstimate.h"

#include "calibration/ImuExtrinsicsReport.h"
#include "calibration/seenInWorld.h"
#include "estimation/imu/AnalyticDrive.h"

#include <gtest/gtest.h>

namespace scanloom::imu_extrinsics_estimate_unittest
{
namespace
{
const Extrinsics kTruth{at(0.15, -0.3, 2.85, 86, 6, -11), 0.012};

struct SeenDrive
{
  Trajectory poses;
  std::vector<ImuSample> imu;
};

/** 40 s, poses at 5 Hz with errors of 3 mm and 0.03 deg, readings at 200 Hz with a bias; stamps late by the truth's.
 */
SeenDrive seenOf(const AnalyticDrive& drive, unsigned seed)
{
  Noise random(seed);
  const Rigid local_T_map = at(3, -4, 0.5, 70, 4, -7);
  const ImuBias bias{random.normal<3>(1e-3), random.normal<3>(0.01)};
  SeenDrive seen;
  seen.imu = drive.samples(Timestamp{1s}, Timestamp{41s}, 5ms);
  for (ImuSample& sample : seen.imu)
  {
    sample.stamp += fromSeconds(kTruth.clock_offset);
    sample.gyro += bias.gyro + random.normal<3>(7e-4);
    sample.accel += bias.accel + random.normal<3>(3.5e-3);
  }
  for (Timestamp stamp{1s}; stamp <= Timestamp{41s}; stamp += 200ms)
  {
    Vector6d error;
    error << random.normal<3>(0.003), random.normal<3>(0.03 * kDegree);
    const Rigid map_T_body = drive.stateAt(stamp, {}).map_T_imu * kTruth.body_T_sensor.inverse();
    seen.poses.push_back({stamp, boxPlus(local_T_map * map_T_body, error)});
  }
  return seen;
}

AnalyticDrive atRest()
{
  AnalyticDrive drive;
  for (Sine* s : {&drive.x, &drive.y, &drive.z, &drive.yaw, &drive.pitch, &drive.roll}) s->rate = s->amplitude = 0;
  return drive;
}

AnalyticDrive onFlatGround()
{
  AnalyticDrive drive;
  drive.z.amplitude = drive.pitch.amplitude = drive.roll.amplitude = 0;
  return drive;
}

Extrinsics off(double metres, double degrees)
{
  const Rigid step =
      Rigid{expSo3(degrees * kDegree * Eigen::Vector3d(0.48, -0.6, 0.64)), metres * Eigen::Vector3d(0.6, 0.64, -0.48)};
  return {kTruth.body_T_sensor * step, 0};
}

ImuExtrinsicsEstimate calibrated(const SeenDrive& seen, const Extrinsics& given)
{
  const std::optional<Extrinsics> start = imuExtrinsicsByTurns(seen.poses, seen.imu, given);
  return start ? estimateImuExtrinsics(seen.poses, seen.imu, given, *start, {})
               : withoutImuExtrinsics(seen.poses, given);
}

Vector7d errorOf(const ImuExtrinsicsEstimate& estimate)
{
  Vector7d error;
  error << estimate.extrinsics.body_T_sensor.translation - kTruth.body_T_sensor.translation,
      logSo3(estimate.extrinsics.body_T_sensor.rotation * kTruth.body_T_sensor.rotation.conjugate()),
      estimate.extrinsics.clock_offset - kTruth.clock_offset;
  return error;
}

void expectRight(const ImuExtrinsicsEstimate& estimate)
{
  ASSERT_TRUE(trusted(estimate)) << inWords(estimate);
  const Vector7d error = errorOf(estimate);
  EXPECT_LT(error.head<3>().norm(), 0.02) << inWords(estimate);
  EXPECT_LT(error.segment<3>(3).norm() / kDegree, 0.05) << inWords(estimate);
  EXPECT_LT(std::abs(error[6]), 0.001) << inWords(estimate);
}

void expectAsGiven(const ImuExtrinsicsEstimate& estimate, const Extrinsics& given)
{
  EXPECT_FALSE(hasNumbers(estimate)) << inWords(estimate);
  EXPECT_FALSE(trusted(estimate));
  EXPECT_EQ(estimate.extrinsics.body_T_sensor.translation, given.body_T_sensor.translation);
  EXPECT_EQ(estimate.extrinsics.body_T_sensor.rotation.coeffs(), given.body_T_sensor.rotation.coeffs());
}
}  // namespace

TEST(ImuExtrinsicsEstimate, ofAnImuThreeDegreesAndTenCentimetresOffIsItsPoseAndClock)
{
  expectRight(calibrated(seenOf({}, 1), off(0.1, 3)));
}

TEST(ImuExtrinsicsEstimate, ofAnImuTwentyDegreesAndHalfAMetreOffIsItsPoseAndClock)
{
  expectRight(calibrated(seenOf({}, 2), off(0.5, 20)));
}

TEST(ImuExtrinsicsEstimate, isAsFarOffAsItsCovarianceSays)
{
  constexpr unsigned kDrives = 10;
  double nees = 0;
  for (unsigned seed = 1; seed <= kDrives; ++seed)
  {
    const ImuExtrinsicsEstimate estimate = calibrated(seenOf({}, seed), off(0.1, 3));
    const Vector7d error = errorOf(estimate);
    nees += error.dot(estimate.covariance.inverse() * error) / kDrives;
  }
  EXPECT_LT(nees, 14);  // 7 is right
  EXPECT_GT(nees, 0.1);
}

TEST(ImuExtrinsicsEstimate, ofAMachineThatStandsStillIsNone)
{
  const ImuExtrinsicsEstimate estimate = calibrated(seenOf(atRest(), 3), off(0.1, 3));
  expectAsGiven(estimate, off(0.1, 3));
  EXPECT_EQ(estimate.outcome, ImuExtrinsicsOutcome::TurnedTooLittle);
}

TEST(ImuExtrinsicsEstimate, ofADriveStraightOnIsNone)
{
  AnalyticDrive straight = atRest();
  straight.x = {0, 1, 0.3, 1.7, 0};
  const ImuExtrinsicsEstimate estimate = calibrated(seenOf(straight, 4), off(0.1, 3));
  expectAsGiven(estimate, off(0.1, 3));
  EXPECT_NE(inWords(estimate).find("drive winding"), std::string::npos);
}

TEST(ImuExtrinsicsEstimate, ofADriveOnFlatGroundIsNotTold)
{
  EXPECT_FALSE(trusted(calibrated(seenOf(onFlatGround(), 5), off(0.1, 3))));
}

TEST(ImuExtrinsicsEstimate, keepsTheHeightThatGroundNearlyFlatLeavesOpen)
{
  AnalyticDrive drive = onFlatGround();
  drive.pitch.amplitude = drive.roll.amplitude = 0.5 * kDegree;
  const Extrinsics given = off(0.1, 3);
  const SeenDrive seen = seenOf(drive, 6);
  const Extrinsics start{kTruth.body_T_sensor, kTruth.clock_offset};
  const ImuExtrinsicsEstimate estimate = estimateImuExtrinsics(seen.poses, seen.imu, given, start, {});
  ASSERT_EQ(estimate.outcome, ImuExtrinsicsOutcome::Open) << inWords(estimate);
  const Vector7d error = errorOf(estimate);
  EXPECT_LT(error.head<2>().norm(), 0.08) << inWords(estimate);
  EXPECT_NE(inWords(estimate).find("OPEN: z"), std::string::npos) << inWords(estimate);
  const Eigen::Vector3d &kept = estimate.extrinsics.body_T_sensor.translation,
                        &told = estimate.by_drive.body_T_sensor.translation;
  EXPECT_GT(std::abs(told.z() - kept.z()), 0.001);
}

TEST(ImuExtrinsicsEstimate, ofAnotherDrivesImuIsNone)
{
  SeenDrive seen = seenOf({}, 7);
  AnalyticDrive other;
  other.yaw = {0, 0, 0.4, 1.3, 0}, other.roll = {0, 0, 0.1, 2.7, 0.3}, other.pitch = {0, 0, 0.1, 0.9, 2};
  seen.imu = seenOf(other, 8).imu;
  const ImuExtrinsicsEstimate estimate = calibrated(seen, off(0.1, 3));
  expectAsGiven(estimate, off(0.1, 3));
  EXPECT_EQ(estimate.outcome, ImuExtrinsicsOutcome::Contradicted);
}

TEST(ImuExtrinsicsEstimate, ofAnImuInDegreesPerSecondIsNone)
{
  SeenDrive seen = seenOf({}, 9);
  for (ImuSample& sample : seen.imu) sample.gyro /= kDegree;
  const ImuExtrinsicsEstimate estimate = calibrated(seen, off(0.1, 3));
  expectAsGiven(estimate, off(0.1, 3));
  EXPECT_EQ(estimate.outcome, ImuExtrinsicsOutcome::Contradicted);
}

TEST(ImuExtrinsicsEstimate, ofLeftHandedAxesIsNone)
{
  SeenDrive seen = seenOf({}, 10);
  for (ImuSample& sample : seen.imu) sample.gyro = -sample.gyro;
  expectAsGiven(calibrated(seen, off(0.1, 3)), off(0.1, 3));
}

TEST(ImuExtrinsicsEstimate, ofAccelerationsInUnitsOfGravityIsNone)
{
  SeenDrive seen = seenOf({}, 11);
  for (ImuSample& sample : seen.imu) sample.accel /= kGravity;
  expectAsGiven(calibrated(seen, off(0.1, 3)), off(0.1, 3));
}

TEST(ImuExtrinsicsEstimate, ofNoReadingsOrPosesIsNone)
{
  const SeenDrive seen = seenOf({}, 12);
  expectAsGiven(calibrated({seen.poses, {}}, off(0.1, 3)), off(0.1, 3));
  expectAsGiven(calibrated({{}, seen.imu}, off(0.1, 3)), off(0.1, 3));
  expectAsGiven(estimateImuExtrinsics({}, {}, off(0.1, 3), off(0.1, 3), {}), off(0.1, 3));
}
}  // namespace scanloom::imu_extrinsics_estimate_unittest
