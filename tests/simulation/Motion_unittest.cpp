#include "imu/Preintegration.h"
#include "simulation/Drive.h"
#include "simulation/SimulatedImu.h"

#include <gtest/gtest.h>

namespace scanloom
{
namespace
{
Drive lively()
{
  DriveOptions options;
  options.sway_deg = 3;
  return {options, Ground(GroundOptions{})};
}

constexpr double kStep = 1e-4;  // s, of the central differences

TEST(Drive, hasTheVelocityAndAccelerationOfItsPositions)
{
  const Drive drive = lively();
  for (double t = 2; t < 21; t += 0.37)
  {
    const Motion before = drive.at(t - kStep), now = drive.at(t), after = drive.at(t + kStep);
    const Eigen::Vector3d velocity = (after.world_T_body.translation - before.world_T_body.translation) / (2 * kStep);
    EXPECT_LT((now.velocity - velocity).norm(), 1e-7) << t;
    EXPECT_LT((now.acceleration - (after.velocity - before.velocity) / (2 * kStep)).norm(), 1e-6) << t;
  }
}

TEST(Drive, hasTheTurnRatesOfItsRotations)
{
  const Drive drive = lively();
  for (double t = 2; t < 21; t += 0.37)
  {
    const Motion before = drive.at(t - kStep), now = drive.at(t), after = drive.at(t + kStep);
    const Eigen::Vector3d rate =
        logSo3(before.world_T_body.rotation.conjugate() * after.world_T_body.rotation) / (2 * kStep);
    EXPECT_LT((now.angular_rate - rate).norm(), 1e-6) << t;
    EXPECT_LT((now.angular_acceleration - (after.angular_rate - before.angular_rate) / (2 * kStep)).norm(), 1e-6) << t;
  }
}

TEST(Drive, restsBeforeItStartsAndAfterItStopped)
{
  const Drive drive = lively();

  EXPECT_EQ(boxMinus(drive.at(2.5).world_T_body, drive.at(0).world_T_body).norm(), 0);
  EXPECT_LT(boxMinus(drive.at(22).world_T_body, drive.at(19.6).world_T_body).norm(), 1e-12);
  EXPECT_EQ(drive.at(1).velocity.norm(), 0);
  EXPECT_GT(drive.at(10).velocity.norm(), 0.79);
}

TEST(Drive, refusesRestsLongerThanTheRecording)
{
  DriveOptions options;
  options.duration = 5;
  EXPECT_THROW(Drive(options, Ground(GroundOptions{})), std::invalid_argument);
}

TEST(SimulatedImu, measuresGravityAtRestWhereverItSits)
{
  const Rigid body_T_imu = Rigid::fromXyzYawPitchRoll(0.1, -0.3, 2.8, 1, 0.2, -0.4);
  const ImuSample sample = idealImuSample(lively().at(1), body_T_imu, Timestamp{});

  EXPECT_EQ(sample.gyro.norm(), 0);
  EXPECT_LT((body_T_imu.rotation * sample.accel - Eigen::Vector3d(0, 0, kGravity)).norm(), 1e-12);
}

TEST(SimulatedImu, withoutErrorsIntegratesToTheDrive)
{
  const Drive drive = lively();
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
  DriveOptions parked;
  parked.duration = 20;
  parked.speed = 0;
  parked.sway_deg = 0;
  const auto samples = simulateImu({parked, Ground(GroundOptions{})}, span, Rigid::identity(), Timestamp{},
                                   Duration{5ms}, errors, 7, RandomStream::BodyImu);

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
