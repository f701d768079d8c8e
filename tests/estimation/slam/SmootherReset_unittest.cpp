#include "estimation/slam/internal/SmootherReset.h"

#include <gtest/gtest.h>

#include "estimation/imu/ImuInitialisation.h"
#include "estimation/slam/internal/SmootherWindow.h"

#include <cmath>

namespace scanloom::smoother_reset_unittest
{
namespace
{
/** Three seconds at rest on level ground, read with this bias and some vibration. */
std::vector<ImuSample> restingImu(const Eigen::Vector3d& accel_bias)
{
  std::vector<ImuSample> samples;
  for (Duration t{0}; t <= 3s; t += 10ms)
  {
    const double shake = 0.01 * std::sin(400 * seconds(t));
    samples.push_back({Timestamp{t}, {shake, 0, 0}, Eigen::Vector3d(shake, 0, kGravity) + accel_bias});
  }
  return samples;
}

double tiltDegrees(const NavEstimate& estimate)
{
  const Eigen::Vector3d up = estimate.state.map_T_imu.rotation * Eigen::Vector3d::UnitZ();
  return std::acos(up.z()) * 180 / M_PI;
}
}  // namespace

TEST(SmootherReset, theBetterAccelerometerTakesOutTheTiltOfTheOneBefore)
{
  const std::vector<ImuSample> in_lidar = restingImu({0.4, -0.2, 0}), of_body = restingImu({0.02, 0.01, 0});
  const NavEstimate tilted = *initialiseAtRest(in_lidar, Rigid::identity(), {}, 0.2);
  ASSERT_GT(tiltDegrees(tilted), 2.5);

  ImuChange change{{Rigid::identity(), {}}, of_body, in_lidar};
  change.imu.noise.accel_bias_sigma = 0.05;
  const NavEstimate continued = continuedBy(change, tilted, Rigid::identity());
  EXPECT_LT(tiltDegrees(continued), 0.5);
  EXPECT_LT(continued.state.bias.accel.norm(), 0.1);

  change.imu.noise.accel_bias_sigma = 2;
  EXPECT_NEAR(tiltDegrees(continuedBy(change, tilted, Rigid::identity())), tiltDegrees(tilted), 0.1);
}

TEST(SmootherReset, aStateInAnotherFrameKeepsItsVelocityAndBiases)
{
  NavEstimate newest = *initialiseAtRest(restingImu({0.02, 0.01, 0}), Rigid::identity(), {}, 0.2);
  newest.state.velocity = {1, 2, 0.1};
  newest.covariance.block<3, 3>(6, 6) = Eigen::Vector3d(1e-4, 4e-4, 9e-4).asDiagonal();
  const Rigid map_T_drive = Rigid::fromXyzYawPitchRoll(10, -20, 3, M_PI / 2, 0, 0);
  const Matrix6d covariance = 1e-4 * Matrix6d::Identity();
  const NavEstimate moved = inFrame(map_T_drive, covariance, newest, {Rigid::identity(), {}});
  EXPECT_LT((moved.state.velocity - Eigen::Vector3d(-2, 1, 0.1)).norm(), 1e-9);
  EXPECT_LT(boxMinus(moved.state.map_T_imu, map_T_drive * newest.state.map_T_imu).norm(), 1e-12);
  EXPECT_EQ(moved.state.bias.accel, newest.state.bias.accel);
  EXPECT_NEAR(moved.covariance(0, 0), 1e-4, 1e-9);
  EXPECT_NEAR(moved.covariance(6, 6), 4e-4, 1e-9) << "y of the drive is x of the map";
  EXPECT_NEAR(moved.covariance(12, 12), newest.covariance(12, 12), 1e-12);
  EXPECT_EQ(moved.covariance(0, 12), 0);
}

TEST(SmootherReset, aWindowBeginsAlsoWithACovarianceThatRoundingHasSpoilt)
{
  NavEstimate start{NavState{}, Matrix15d::Identity()};
  start.covariance(0, 1) = start.covariance(1, 0) = 1 + 1e-9;
  const FixedLagSmoother window = windowFrom(start, {}, {}).smoother;
  EXPECT_NEAR(window.newestCovariance()(0, 0), 1, 1e-6);
}
}  // namespace scanloom::smoother_reset_unittest
