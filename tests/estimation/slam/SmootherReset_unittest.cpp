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
TEST(SmootherReset, aWindowBeginsAlsoWithACovarianceThatRoundingHasSpoilt)
{
  NavEstimate start{NavState{}, Matrix15d::Identity()};
  start.covariance(0, 1) = start.covariance(1, 0) = 1 + 1e-9;
  const FixedLagSmoother window = windowFrom(start, {}, {}).smoother;
  EXPECT_NEAR(window.newestCovariance()(0, 0), 1, 1e-6);
}
}  // namespace scanloom::smoother_reset_unittest
