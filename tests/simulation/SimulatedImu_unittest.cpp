#include "simulation/SimulatedImu.h"

#include "imu/Preintegration.h"

#include <gtest/gtest.h>

namespace scanloom
{
namespace
{
Drive windingDrive(const DriveOptions& options = {}, const GroundOptions& ground = {})
{
  BodyMotionOptions body;
  body.sway_deg = 3;
  return {Route(options, {}, 1), options, body, Ground(ground)};
}

TEST(SimulatedImu, measuresGravityAtRestWhereverItSits)
{
  const Rigid body_T_imu = Rigid::fromXyzYawPitchRoll(0.1, -0.3, 2.8, 1, 0.2, -0.4);
  const Motion parked = windingDrive().at(1);
  const ImuSample sample = idealImuSample(parked, body_T_imu, Timestamp{});

  EXPECT_EQ(sample.gyro.norm(), 0);
  const Eigen::Vector3d in_world = (parked.world_T_body * body_T_imu).rotation * sample.accel;
  EXPECT_LT((in_world - Eigen::Vector3d(0, 0, kGravity)).norm(), 1e-12);
}

TEST(SimulatedImu, withoutErrorsIntegratesToTheDrive)
{
  const Drive drive = windingDrive();
  const Rigid body_T_imu = Rigid::fromXyzYawPitchRoll(0.1, -0.3, 2.8, 1.5, 0.02, -0.01);
  const RecordingSpan span{Timestamp{}, 20};
  const ImuErrors none{{0, 0, 0, 0}, {}};
  const auto samples =
      simulateImu(drive, span, body_T_imu, Timestamp{3s}, Duration{1ms}, none, 1, RandomStream::BodyImu);
  const std::vector<ImuSample> ten_seconds(samples.begin(), samples.begin() + 10'001);

  const Motion start = drive.at(3), end = drive.at(13);
  NavState state;
  state.stamp = Timestamp{3s};
  state.map_T_imu = start.world_T_body * body_T_imu;
  state.velocity =
      start.velocity + start.world_T_body.rotation * start.angular_rate.cross(body_T_imu.translation).eval();
  const NavState predicted = predictAt(state, ten_seconds, {Timestamp{13s}}).front();

  const Vector6d error = boxMinus(predicted.map_T_imu, end.world_T_body * body_T_imu);
  EXPECT_LT(error.head<3>().norm(), 1e-3) << "m";
  EXPECT_LT(error.tail<3>().norm(), 1e-5) << "rad";
}

TEST(SimulatedImu, hasTheNoiseThatWasAskedFor)
{
  const RecordingSpan span{Timestamp{}, 20};
  const ImuErrors errors{{0.01, 1e-3, 0, 0}, {{0, 0, 0.5}, {0, 0.1, 0}}};
  const GroundOptions level{0, 0};
  DriveOptions parked;
  parked.duration = 20;
  parked.route = "work";
  parked.standstill = 21;
  parked.speed_up = 1;
  const auto samples = simulateImu(windingDrive(parked, level), span, Rigid::identity(), Timestamp{}, Duration{5ms},
                                   errors, 7, RandomStream::BodyImu);

  double gyro = 0, accel = 0;
  for (const ImuSample& sample : samples)
  {
    gyro += std::pow(sample.gyro.z() - 0.5, 2);
    accel += std::pow(sample.accel.y() - 0.1, 2);
  }
  ASSERT_EQ(samples.size(), 4000U);
  EXPECT_NEAR(std::sqrt(gyro / 4000), 0.01 * M_PI / 180 * std::sqrt(200), 0.05 * 0.01 * M_PI / 180 * std::sqrt(200));
  EXPECT_NEAR(std::sqrt(accel / 4000), 1e-3 * std::sqrt(200), 0.05 * 1e-3 * std::sqrt(200));
}
}  // namespace
}  // namespace scanloom
