#include "estimation/imu/ImuInitialisation.h"

#include "base/core/Angle.h"
#include "base/core/Decompositions.h"
#include "base/formats/ImuCsv.h"
#include "estimation/imu/AnalyticDrive.h"
#include "support/TestData.h"

#include <gtest/gtest.h>

namespace scanloom::imu_initialisation_unittest
{
namespace
{
/** 200 Hz readings of a body that stands still; `vibration` (m/s2 and deg/s) is a 4-cylinder engine's 26 Hz. */
std::vector<ImuSample> atRest(const Rigid& map_T_body, const ImuBias& bias, double vibration, Duration length = 2100ms)
{
  const Rigid map_T_imu = map_T_body * kBodyFromImu;
  const Eigen::Vector3d up = map_T_imu.rotation.conjugate() * -gravityInMap();
  Noise random(5);
  std::vector<ImuSample> samples;
  for (Duration t = 0ms; t <= length; t += 5ms)
  {
    const double swing = vibration * std::sin(2 * M_PI * 26 * seconds(t));
    const Eigen::Vector3d shaken{swing, 0.5 * swing, 0.8 * swing};
    samples.push_back({Timestamp{t}, bias.gyro + kDegree * shaken + random.normal<3>(0.05 * kDegree),
                       up + bias.accel + shaken + random.normal<3>(0.004)});
  }
  return samples;
}

const Rigid kTilted = Rigid::fromXyzYawPitchRoll(0, 0, 0, 0, 5 * kDegree, -3 * kDegree);
const ImuBias kGyroOnly{{0.01, -0.005, 0.008}, Eigen::Vector3d::Zero()};

double tiltBetween(const NavState& a, const Rigid& map_T_imu)
{
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  return std::acos(std::min(1.0, (a.map_T_imu.rotation.conjugate() * z).dot(map_T_imu.rotation.conjugate() * z)));
}

std::vector<ImuSample> part(const std::vector<ImuSample>& samples, Duration from, Duration to)
{
  std::vector<ImuSample> inside;
  for (const ImuSample& s : samples)
    if (s.stamp - samples.front().stamp >= from && s.stamp - samples.front().stamp <= to) inside.push_back(s);
  return inside;
}
}  // namespace

TEST(ImuInitialisation, findsTiltAndGyroBiasOfAQuietMachine)
{
  const auto start = initialiseAtRest(atRest(kTilted, kGyroOnly, 0), kBodyFromImu, {});
  ASSERT_TRUE(start);
  EXPECT_EQ(start->state.stamp, Timestamp{2100ms});
  const Rigid map_T_body = start->state.map_T_imu * kBodyFromImu.inverse();
  EXPECT_LT(boxMinus(map_T_body, kTilted).norm(), 2e-4);  // position 0 and yaw 0 of the body among them
  EXPECT_LT((start->state.bias.gyro - kGyroOnly.gyro).norm(), 0.01 * kDegree);
  EXPECT_EQ(start->state.velocity.norm(), 0);
}

/** Amplitude on the strongest axis; 1 m/s2 comes with 1 deg/s. */
using AnEngine = testing::TestWithParam<double>;
INSTANTIATE_TEST_SUITE_P(OfG, AnEngine, testing::Values(0.1, 0.3, 0.6, 1.5));

TEST_P(AnEngine, doesNotHideAStandstill)
{
  const auto start = initialiseAtRest(atRest(kTilted, kGyroOnly, GetParam() * kGravity), kBodyFromImu, {});
  ASSERT_TRUE(start);
  EXPECT_LT(tiltBetween(start->state, kTilted * kBodyFromImu), 0.02 * kDegree);
  EXPECT_LT((start->state.bias.gyro - kGyroOnly.gyro).norm(), 0.02 * kDegree);
}

TEST_P(AnEngine, doesNotHideAMotion)
{
  const AnalyticDrive drive;
  auto samples = drive.samples(Timestamp{1s}, Timestamp{4s}, 5ms);
  for (ImuSample& s : samples)
    s.accel.z() += GetParam() * kGravity * std::sin(2 * M_PI * 26 * seconds(s.stamp.time_since_epoch()));
  EXPECT_FALSE(initialiseAtRest(samples, kBodyFromImu, {}));
}

/** As strong at all frequencies: panels that rattle. */
TEST(ImuInitialisation, survivesShakingWithoutAFrequency)
{
  Noise random(11);
  auto samples = atRest(kTilted, kGyroOnly, 0);
  for (ImuSample& s : samples) s.accel += random.normal<3>(1.5);
  const auto start = initialiseAtRest(samples, kBodyFromImu, {});
  ASSERT_TRUE(start) << "seed 11";
  const double tilt = tiltBetween(start->state, kTilted * kBodyFromImu);
  EXPECT_LT(tilt, 3 * 1.5 * std::sqrt(2 * 1.5 / 400) / kGravity) << "a mean of 400 readings, weighted by a Hann window";
}

TEST(ImuInitialisation, takesTheAccelerometerBiasAlongGravity)
{
  const Eigen::Vector3d up = (kTilted * kBodyFromImu).rotation.conjugate() * Eigen::Vector3d::UnitZ();
  const auto start = initialiseAtRest(atRest(kTilted, {Eigen::Vector3d::Zero(), 0.12 * up}, 0), kBodyFromImu, {});
  ASSERT_TRUE(start);
  EXPECT_LT((start->state.bias.accel - 0.12 * up).norm(), 2e-3);
}

TEST(ImuInitialisation, doesNotTakeAMotionForRest)
{
  const AnalyticDrive drive;
  EXPECT_FALSE(initialiseAtRest(drive.samples(Timestamp{1s}, Timestamp{4s}, 5ms), kBodyFromImu, {}));
}

TEST(ImuInitialisation, doesNotTakeASteadyTurnForAGyroBias)
{
  const ImuBias turn{{0, 0, 5 * kDegree}, Eigen::Vector3d::Zero()};
  EXPECT_FALSE(initialiseAtRest(atRest(kTilted, turn, 0), kBodyFromImu, {}));
}

TEST(ImuInitialisation, asksForTheWholeDuration)
{
  EXPECT_FALSE(initialiseAtRest(atRest(kTilted, {}, 0, 1900ms), kBodyFromImu, {}));
  EXPECT_FALSE(initialiseAtRest({}, kBodyFromImu, {}));
}

TEST(ImuInitialisation, refusesReadingsInUnitsOfG)
{
  auto samples = atRest(kTilted, {}, 0);
  for (ImuSample& s : samples) s.accel /= kGravity;
  EXPECT_FALSE(initialiseAtRest(samples, kBodyFromImu, {}));
}

TEST(ImuInitialisation, covarianceCoversTiltByAnUnknownAccelerometerBias)
{
  // The biases have six degrees of freedom; tilt and the IMU's swing about the body's origin follow from them.
  constexpr double kAccelBias = 0.07;  // m/s2
  Noise random(3);
  double nees = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run)
  {
    const ImuBias bias{random.normal<3>(0.002), random.normal<3>(kAccelBias)};
    const auto start = initialiseAtRest(atRest(kTilted, bias, 0), kBodyFromImu, {}, kAccelBias);
    ASSERT_TRUE(start);
    NavState truth = start->state;
    truth.map_T_imu = kTilted * kBodyFromImu;
    truth.bias = bias;
    const Vector15d error = boxMinus(truth, start->state);
    nees += error.dot(solveSymmetric(start->covariance, error)) / kRuns;
  }
  // Two for the bias across gravity; along it, and for gyro, position and yaw, the floors are wider than the errors
  // here.
  EXPECT_GT(nees, 2) << "seed 3";
  EXPECT_LT(nees, 6) << "seed 3";
}

TEST(ImuInitialisation, hasGravityFromAFewSamplesOnTheMove)
{
  const AnalyticDrive drive;
  const auto samples = drive.samples(Timestamp{1s}, Timestamp{1300ms}, 10ms);
  const NavEstimate start = gravityOnly(samples, Rigid::identity());
  EXPECT_EQ(start.state.bias.gyro.norm(), 0);
  const double tilt = tiltBetween(start.state, drive.stateAt(start.state.stamp).map_T_imu);
  EXPECT_LT(tilt, 3 * std::sqrt(start.covariance.block<3, 3>(3, 3).trace()));
  EXPECT_LT(std::abs(start.state.map_T_imu.yawPitchRoll().x()), 1e-12);
}

TEST(ImuInitialisation, needsAForceToTellUp)
{
  EXPECT_THROW(gravityOnly({}, kBodyFromImu), std::invalid_argument);
  EXPECT_THROW(gravityOnly({ImuSample{}}, kBodyFromImu), std::invalid_argument);
}

TEST(ImuInitialisation, withoutAnImuTheMapIsAsLevelAsTheBody)
{
  const NavEstimate start = levelWithBody(Timestamp{5s});
  EXPECT_EQ(start.state.stamp, Timestamp{5s});
  EXPECT_LT(start.state.map_T_imu.rotation.angularDistance(Eigen::Quaterniond::Identity()), 1e-12);
  const Eigen::VectorXd sigma = start.covariance.diagonal().cwiseSqrt();
  EXPECT_LE(sigma.head<6>().maxCoeff(), 1e-3);     // it is defined so
  EXPECT_GE(sigma.segment<3>(6).minCoeff(), 1.0);  // m/s: the machine may be driving
  EXPECT_LE(sigma.tail<6>().maxCoeff(), 1e-5);     // what is assumed has no bias
}

TEST(ImuInitialisation, tellsTheStandstillOfARecordingFromItsDrive)
{
  SCANLOOM_NEEDS_DATA(file, "recordings/sparse/imu.csv");
  const std::vector<ImuSample> samples = readImuCsv(file).readings.samples;
  const auto start = initialiseAtRest(part(samples, 0s, 2500ms), kBodyFromImu, {});
  ASSERT_TRUE(start);
  // summary.json: the constant part of the simulated bias
  EXPECT_LT((start->state.bias.gyro - Eigen::Vector3d(-1.72e-4, -1.27e-5, 7.32e-4)).norm(), 0.02 * kDegree);

  for (const Duration from : {3s, 5s, 10s, 15s, 20s})
    EXPECT_FALSE(initialiseAtRest(part(samples, from, from + 2100ms), kBodyFromImu, {})) << seconds(from);
}
}  // namespace scanloom::imu_initialisation_unittest
