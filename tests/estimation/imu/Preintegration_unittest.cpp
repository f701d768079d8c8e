#include "estimation/imu/Preintegration.h"

#include "base/core/Decompositions.h"
#include "estimation/imu/AnalyticDrive.h"
#include "estimation/imu/ImuBuffer.h"
#include "support/checkJacobian.h"

#include <Eigen/Cholesky>

namespace scanloom::preintegration_unittest
{
namespace
{
const AnalyticDrive kDrive;
const ImuBias kBias{{0.02, -0.03, 0.01}, {0.1, -0.2, 0.15}};

/** Rotation, velocity, position: what leads from `from` to `to`, in from's tangent. */
Vector9d difference(const ImuDelta& to, const ImuDelta& from)
{
  Vector9d d;
  d << logSo3(from.rotation.conjugate() * to.rotation), to.velocity - from.velocity, to.position - from.position;
  return d;
}

ImuDelta deltaOf(const Preintegration& m) { return m.delta; }

ImuBias biasPlus(const ImuBias& bias, const Vector6d& step)
{
  return {bias.gyro + step.head<3>(), bias.accel + step.tail<3>()};
}

/** A white reading's standard deviation is the density over the root of the period. */
std::vector<ImuSample> withNoise(std::vector<ImuSample> samples, const ImuNoise& noise, Duration period, Noise& random)
{
  const double root = std::sqrt(seconds(period));
  for (ImuSample& s : samples)
  {
    s.gyro += random.normal<3>(noise.gyro_noise_deg * M_PI / 180 / root);
    s.accel += random.normal<3>(noise.accel_noise / root);
  }
  return samples;
}

double errorOfPrediction(Duration period)
{
  const auto samples = kDrive.samples(Timestamp{1s}, Timestamp{3s}, period);
  const NavState end = predict(kDrive.stateAt(Timestamp{1s}), preintegrate(samples, {}, {}));
  return boxMinus(end, kDrive.stateAt(Timestamp{3s})).norm();
}
}  // namespace

TEST(Preintegration, isExactForConstantReadings)
{
  // M. Burri's and GTSAM's known answer: 0.5 s at 0.1 m/s2 and pi/100 rad/s, both along x.
  const Eigen::Vector3d gyro{M_PI / 100, 0, 0}, accel{0.1, 0, 0};
  std::vector<ImuSample> samples;
  for (Duration t = 0ms; t <= 500ms; t += 5ms) samples.push_back({Timestamp{t}, gyro, accel});
  const Preintegration motion = preintegrate(samples, {}, {});

  EXPECT_LT(logSo3(expSo3(gyro * 0.5).conjugate() * motion.delta.rotation).norm(), 1e-14);
  EXPECT_LT((motion.delta.velocity - Eigen::Vector3d(0.05, 0, 0)).norm(), 1e-14);
  EXPECT_LT((motion.delta.position - Eigen::Vector3d(0.0125, 0, 0)).norm(), 1e-14);
  EXPECT_EQ(motion.duration(), 0.5);
}

TEST(Preintegration, followsAnAnalyticDriveAt200Hz)
{
  EXPECT_LT(errorOfPrediction(5ms), 1e-4);  // 2 s, metres and radians and m/s together
}

TEST(Preintegration, isOfSecondOrderInThePeriod)
{
  EXPECT_NEAR(errorOfPrediction(20ms) / errorOfPrediction(10ms), 4, 0.1);
  EXPECT_NEAR(errorOfPrediction(10ms) / errorOfPrediction(5ms), 4, 0.1);
}

TEST(Preintegration, losesNothingWhereScansCutTheSamples)
{
  ImuBuffer buffer;
  for (const ImuSample& s : kDrive.samples(Timestamp{1s}, Timestamp{3s}, 5ms)) buffer.add(s);
  const NavState start = kDrive.stateAt(Timestamp{1s + 3ms});
  const auto carriedTo = [&](const NavState& from, Timestamp to)
  { return predict(from, preintegrate(buffer.between(from.stamp, to), {}, {})); };

  NavState in_parts = start;
  for (Duration t = 1s + 104ms; t <= 2s + 909ms; t += 101ms) in_parts = carriedTo(in_parts, Timestamp{t});
  const NavState at_once = carriedTo(start, in_parts.stamp);
  EXPECT_LT(boxMinus(in_parts, at_once).norm(), 1e-6);
}

TEST(Preintegration, covarianceEqualsThatOfTenThousandRuns)
{
  const ImuNoise noise{0.1, 5e-3, 4e-4, 1e-4};
  const auto truth = kDrive.samples(Timestamp{1s}, Timestamp{1500ms}, 5ms, kBias);
  const Preintegration exact = preintegrate(truth, kBias, noise);

  Noise random(7);
  Matrix9d sum = Matrix9d::Zero();
  constexpr int kRuns = 10000;
  for (int run = 0; run < kRuns; ++run)
  {
    const auto noisy = withNoise(truth, noise, 5ms, random);
    ImuDelta delta;
    for (std::size_t k = 0; k + 1 < noisy.size(); ++k) delta = advance(delta, noisy[k], noisy[k + 1], kBias);
    const Vector9d error = difference(delta, deltaOf(exact));
    sum += error * error.transpose();
  }

  const Matrix9d half = exact.covariance.llt().matrixL();
  const Matrix9d left = half.triangularView<Eigen::Lower>().solve(Matrix9d(sum / kRuns));
  const Matrix9d whitened = half.triangularView<Eigen::Lower>().solve(Matrix9d(left.transpose()));
  EXPECT_LT((whitened - Matrix9d::Identity()).norm() / Matrix9d::Identity().norm(), 0.05) << "seed 7";
}

TEST(Preintegration, errorsOfFiftyRunsAreAsLargeAsTheCovarianceSays)
{
  const ImuNoise noise{0.1, 5e-3, 4e-4, 1e-4};
  Noise random(11);
  double nees = 0;
  constexpr int kRuns = 50;
  for (int run = 0; run < kRuns; ++run)
  {
    const Timestamp from{1s + run * 100ms};
    const auto truth = kDrive.samples(from, from + 300ms, 5ms, kBias);
    const Preintegration exact = preintegrate(truth, kBias, noise);
    const Preintegration noisy = preintegrate(withNoise(truth, noise, 5ms, random), kBias, noise);
    const Vector9d error = difference(deltaOf(noisy), deltaOf(exact));
    nees += error.dot(solveSymmetric(noisy.covariance, error)) / kRuns;
  }
  EXPECT_GT(nees, 7.9) << "seed 11";
  EXPECT_LT(nees, 10.2) << "seed 11";
}

TEST(Preintegration, isAsUnsureAcrossAGapAsAMovingMachineIsUnseenThere)
{
  double nees = 0;
  constexpr int kRuns = 50;
  for (int run = 0; run < kRuns; ++run)
  {
    const Timestamp from{1s + run * 100ms};
    const auto truth = kDrive.samples(from, from + 500ms, 5ms);
    const Vector9d straight = difference(deltaOf(preintegrate(truth, {}, {})), {});
    std::vector<ImuSample> samples = truth;
    samples.erase(samples.begin() + 20, samples.begin() + 60);
    const Preintegration motion = preintegrate(samples, {}, {});
    const Vector9d error = difference(deltaOf(motion), {}) - straight;
    nees += error.dot(solveSymmetric(motion.covariance, error)) / kRuns;
    EXPECT_LT(motion.covariance(0, 0), 0.04 * 0.04);
  }
  EXPECT_LT(nees, 9);
}

TEST(Preintegration, isAsUnsureWhereReadingsWereRefusedAsAShockThereMayHaveBeen)
{
  // 2 g for 15 ms, of which the IMU's samples say nothing.
  const Eigen::Vector3d shock(2 * kGravity, 0, 0);
  std::vector<ImuSample> samples;
  for (Duration t = 0ms; t <= 100ms; t += 5ms)
  {
    if (t > 40ms && t < 60ms) continue;
    samples.push_back({Timestamp{t}, {0, 0, 0}, {0, 0, kGravity}});
    samples.back().after_refused = t == 60ms;
  }
  for (const Timestamp cut : {Timestamp{100ms}, Timestamp{52ms}})
  {
    const Preintegration motion = preintegrate(ImuBuffer(samples).between(Timestamp{0ms}, cut), {}, {});
    const double sigma = std::sqrt(motion.covariance(3, 3));
    const double missed = shock.x() * std::min(0.015, seconds(cut - Timestamp{40ms}));
    EXPECT_LT(missed, 3 * sigma);
    EXPECT_GT(missed, 0.5 * sigma);
  }
}

TEST(Preintegration, biasJacobiansEqualCentralDifferences)
{
  const auto samples = kDrive.samples(Timestamp{1s}, Timestamp{2s}, 5ms, kBias);
  const Preintegration motion = preintegrate(samples, kBias, {});
  Eigen::Matrix<double, 9, 6> analytic;
  analytic << motion.rotation_by_gyro, Eigen::Matrix3d::Zero(),  //
      motion.velocity_by_gyro, motion.velocity_by_accel,         //
      motion.position_by_gyro, motion.position_by_accel;

  checkJacobian(analytic,
                [&](const Eigen::VectorXd& step) -> Eigen::VectorXd
                { return difference(deltaOf(preintegrate(samples, biasPlus(kBias, step), {})), deltaOf(motion)); });
}

TEST(Preintegration, errorOfFirstOrderFallsByFourWhenTheBiasStepIsHalved)
{
  const auto samples = kDrive.samples(Timestamp{1s}, Timestamp{2s}, 5ms, kBias);
  const Preintegration motion = preintegrate(samples, kBias, {});
  const auto errorAt = [&](double share)
  {
    Vector6d step;
    step << 0.04, -0.03, 0.05, 0.2, 0.3, -0.1;
    const ImuBias moved = biasPlus(kBias, share * step);
    return difference(deltaAt(motion, moved), deltaOf(preintegrate(samples, moved, {})));
  };
  for (const auto part : {0, 3, 6})
    EXPECT_NEAR(errorAt(1.0).segment<3>(part).norm() / errorAt(0.5).segment<3>(part).norm(), 4, 0.4) << part;
}

TEST(Preintegration, isIntegratedAgainOnlyWhenTheBiasHasMovedFar)
{
  const auto samples = kDrive.samples(Timestamp{1s}, Timestamp{2s}, 5ms, kBias);
  const Preintegration motion = preintegrate(samples, kBias, {});
  const auto linearisedAt = [&](double gyro, double accel)
  {
    return corrected(motion, {kBias.gyro + Eigen::Vector3d(gyro, 0, 0), kBias.accel + Eigen::Vector3d(0, accel, 0)},
                     {});
  };

  EXPECT_EQ(linearisedAt(0.009, 0.09).bias.gyro, kBias.gyro);
  EXPECT_EQ(linearisedAt(0.011, 0).bias.gyro, kBias.gyro + Eigen::Vector3d(0.011, 0, 0));
  EXPECT_EQ(linearisedAt(0, 0.11).bias.accel, kBias.accel + Eigen::Vector3d(0, 0.11, 0));

  const ImuBias far{kBias.gyro + Eigen::Vector3d(0.02, 0, 0), kBias.accel};
  EXPECT_EQ(linearisedAt(0.02, 0).delta.position, preintegrate(samples, far, {}).delta.position);
}

TEST(Preintegration, predictsEveryStampOnTheWay)
{
  const auto samples = kDrive.samples(Timestamp{1s}, Timestamp{1200ms}, 5ms, kBias);
  const std::vector<Timestamp> stamps{Timestamp{1s},     Timestamp{1s + 1ms}, Timestamp{1005ms},
                                      Timestamp{1099ms}, Timestamp{1099ms},   Timestamp{1200ms}};
  const auto states = predictAt(kDrive.stateAt(Timestamp{1s}, kBias), samples, stamps);

  ASSERT_EQ(states.size(), stamps.size());
  for (std::size_t k = 0; k < stamps.size(); ++k)
  {
    EXPECT_EQ(states[k].stamp, stamps[k]);
    EXPECT_LT(boxMinus(states[k], kDrive.stateAt(stamps[k], kBias)).norm(), 1e-5) << k;
  }
  const NavState by_motion = predict(kDrive.stateAt(Timestamp{1s}, kBias), preintegrate(samples, kBias, {}));
  EXPECT_LT(boxMinus(states.back(), by_motion).norm(), 1e-14);
}

TEST(Preintegration, refusesAnIntervalWithoutDuration)
{
  const ImuSample sample = kDrive.sampleAt(Timestamp{1s});
  EXPECT_THROW(preintegrate({}, {}, {}), std::invalid_argument);
  EXPECT_THROW(preintegrate({sample}, {}, {}), std::invalid_argument);
  EXPECT_THROW(preintegrate({sample, sample}, {}, {}), std::invalid_argument);
}

TEST(Preintegration, refusesToPredictFromAnotherInstant)
{
  const auto samples = kDrive.samples(Timestamp{1s}, Timestamp{1100ms}, 5ms);
  const NavState other = kDrive.stateAt(Timestamp{1001ms});
  EXPECT_THROW(predict(other, preintegrate(samples, {}, {})), std::invalid_argument);
  EXPECT_THROW(predictAt(other, samples, {}), std::invalid_argument);
  EXPECT_THROW(predictAt(kDrive.stateAt(Timestamp{1s}), samples, {Timestamp{1101ms}}), std::invalid_argument);
  EXPECT_THROW(predictAt(kDrive.stateAt(Timestamp{1s}), samples, {Timestamp{1050ms}, Timestamp{1040ms}}),
               std::invalid_argument);
}
}  // namespace scanloom::preintegration_unittest
