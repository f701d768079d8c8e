/** The smoother on an IMU that a stranger's generator made: frames, signs, gravity and noise are not ours. */
#include "base/core/Angle.h"
#include "base/formats/ImuCsv.h"
#include "base/formats/Trajectory.h"
#include "estimation/graph/FixedLagSmoother.h"
#include "estimation/imu/AnalyticDrive.h"
#include "estimation/imu/ImuBuffer.h"
#include "estimation/imu/ImuInitialisation.h"
#include "support/TestData.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace scanloom::fixed_lag_smoother_on_recording_unittest
{
namespace
{
// extrinsics.txt and summary.json of the recording
const Rigid kBodyFromRealImu =
    Rigid::fromXyzYawPitchRoll(0.15, -0.3, 2.85, 90 * kDegree, 1.2 * kDegree, -0.8 * kDegree);
const Eigen::Vector3d kGyroBias{-1.7242e-4, -1.268e-5, 7.3215e-4};
const Eigen::Vector3d kAccelBias{-1.516e-3, -7.99e-4, 2.566e-3};

struct Outcomes
{
  NavState last;
  std::vector<double> prediction_errors, prediction_angles;  // m and rad, of the body before its lidar pose is added
  std::vector<double> errors;                                // m, after
};

/** Lidar poses of 1 cm and 0.05 deg every `period` from the standstill's end on. */
Outcomes runOn(const std::filesystem::path& recording, Duration period)
{
  ImuBuffer imu;
  for (const ImuSample& s : readImuCsv(recording / "imu.csv").readings.samples) imu.add(s);
  const Trajectory truth = readTum(recording / "groundtruth.tum");
  const Timestamp start = imu.samples().front().stamp + 2500ms;
  NavEstimate first = *initialiseAtRest(imu.between(start - 2100ms, start), kBodyFromRealImu, {});
  const Rigid at_start = poseAt(truth, start).value();
  const Rigid map_T_world = Rigid::fromXyzYawPitchRoll(0, 0, 0, -at_start.yawPitchRoll().x(), 0, 0) *
                            Rigid{Eigen::Quaterniond::Identity(), -at_start.translation};

  const ImuNoise noise;
  FixedLagSmoother smoother(first.state, first.covariance, kBodyFromRealImu, noise, {});
  Noise random(1);
  Matrix6d information = Matrix6d::Zero();
  information.diagonal().head<3>().setConstant(1 / (0.01 * 0.01));
  information.diagonal().tail<3>().setConstant(1 / (0.05 * kDegree * 0.05 * kDegree));
  Outcomes out;
  for (Timestamp t = start + period; t < truth.back().stamp && t < imu.samples().back().stamp; t += period)
  {
    const Rigid map_T_body = map_T_world * poseAt(truth, t).value();
    const auto errorNow = [&]
    { return boxMinus(smoother.newest().map_T_imu * kBodyFromRealImu.inverse(), map_T_body); };

    smoother.addState(preintegrate(imu.between(smoother.newest().stamp, t), smoother.newest().bias, noise));
    out.prediction_errors.push_back(errorNow().head<3>().norm());
    out.prediction_angles.push_back(errorNow().tail<3>().norm());
    Vector6d step;
    step << random.normal<3>(0.01), random.normal<3>(0.05 * kDegree);
    smoother.addPosePrior(boxPlus(map_T_body, step), information);
    smoother.optimise();
    EXPECT_TRUE(smoother.report().usable);
    out.errors.push_back(errorNow().head<3>().norm());
  }
  out.last = smoother.newest();
  return out;
}

double quantile(std::vector<double> values, double share)
{
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}
}  // namespace

TEST(FixedLagSmootherOnRecording, findsTheBiasesThatTheRecordingWasMadeWith)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const NavState last = runOn(recording, 100ms).last;
  EXPECT_LT((last.bias.gyro - kGyroBias).norm(), 0.01 * kDegree);
  EXPECT_LT((last.bias.accel - kAccelBias).norm(), 2e-3);
}

TEST(FixedLagSmootherOnRecording, smoothsPosesOfACentimetre)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/dense");
  const Outcomes out = runOn(recording, 100ms);
  EXPECT_LT(quantile(out.errors, 0.5), 0.007);  // of measurements whose median is 15 mm
  EXPECT_LT(quantile(out.errors, 1.0), 0.02);
}

TEST(FixedLagSmootherOnRecording, predictsOverFifteenScans)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const Outcomes out = runOn(recording, 1500ms);
  EXPECT_LT(quantile(out.prediction_errors, 0.5), 0.15);
  EXPECT_LT(quantile(out.prediction_errors, 1.0), 0.5);
  EXPECT_LT(quantile(out.prediction_angles, 0.5), 0.5 * kDegree);
  EXPECT_LT(quantile(out.prediction_angles, 1.0), 2 * kDegree);
}
}  // namespace scanloom::fixed_lag_smoother_on_recording_unittest
