#include "lab/simulation/internal/SimulatedImu.h"

#include "estimation/imu/Preintegration.h"
#include "support/with.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace scanloom::simulated_imu_unittest
{
namespace
{
Drive windingDrive(const DriveOptions& options = {}, const GroundOptions& ground = {})
{
  return {Route(options, {}, 1), options, with(&BodyMotionOptions::sway_deg, 3), Ground(ground)};
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

SimulatedImuOptions ideal(double rate) { return {rate, 0, 0, 0, 0, 1, 0, 0}; }

std::vector<ImuSample> samplesOf(const Drive& drive, const ImuSetup& setup, double seconds)
{
  const RecordingSpan span{Timestamp{}, seconds};
  ImuStream imu(drive, span, setup, 7);
  std::vector<ImuSample> samples;
  for (const ImuStream::Sample& sample : imu.before(span.end())) samples.push_back(sample.reading);
  return samples;
}

/** Rests all the time. */
Drive parked(double seconds)
{
  DriveOptions options;
  options.duration = seconds;
  options.route = "work";
  options.standstill = seconds + 1;
  options.speed_up = 1;
  return windingDrive(options, {0, 0});
}

TEST(SimulatedImu, withoutErrorsIntegratesToTheDrive)
{
  const Drive drive = windingDrive();
  const Rigid body_T_imu = Rigid::fromXyzYawPitchRoll(0.1, -0.3, 2.8, 1.5, 0.02, -0.01);
  const auto samples = samplesOf(drive, {body_T_imu, Timestamp{3s}, ideal(1000), {}}, 20);
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
  RecordProperty("position_um", fmt::format("{:.1f}", 1e6 * error.head<3>().norm()));
  RecordProperty("rotation_urad", fmt::format("{:.3f}", 1e6 * error.tail<3>().norm()));
}

TEST(SimulatedImu, hasTheNoiseThatWasAskedFor)
{
  SimulatedImuOptions errors = ideal(200);
  errors.gyro_noise_deg = 0.01;
  errors.accel_noise = 1e-3;
  const auto samples = samplesOf(parked(20), {{}, Timestamp{}, errors, {}}, 20);

  double gyro = 0, accel = 0;
  for (const ImuSample& sample : samples)
  {
    gyro += std::pow(sample.gyro.z(), 2);
    accel += std::pow(sample.accel.y(), 2);
  }
  ASSERT_EQ(samples.size(), 4000U);
  EXPECT_NEAR(std::sqrt(gyro / 4000), 0.01 * M_PI / 180 * std::sqrt(200), 0.05 * 0.01 * M_PI / 180 * std::sqrt(200));
  EXPECT_NEAR(std::sqrt(accel / 4000), 1e-3 * std::sqrt(200), 0.05 * 1e-3 * std::sqrt(200));
}

TEST(SimulatedImu, hasABiasThatWandersWithoutEverRunningAway)
{
  SimulatedImuOptions errors = ideal(10);
  errors.gyro_instability = 36;  // deg/h
  errors.correlation_time = 1;
  const auto samples = samplesOf(parked(2'000), {{}, Timestamp{}, errors, {}}, 2'000);

  double squares = 0, apart = 0;
  const std::size_t lag = 10;  // one correlation time
  for (std::size_t i = 0; i + lag < samples.size(); ++i)
  {
    squares += std::pow(samples[i].gyro.x(), 2);
    apart += samples[i].gyro.x() * samples[i + lag].gyro.x();
  }
  const double deviation = std::sqrt(squares / static_cast<double>(samples.size() - lag));
  EXPECT_NEAR(deviation, 0.01 * M_PI / 180, 0.05 * 0.01 * M_PI / 180);
  EXPECT_NEAR(apart / squares, std::exp(-1.0), 0.06);
}

TEST(SimulatedImu, stampsByItsOwnClock)
{
  const ClockError clock{100ms, 50, 1s, 10s};
  const auto samples = samplesOf(parked(20), {{}, Timestamp{}, ideal(10), clock}, 20);

  EXPECT_EQ(samples[0].stamp, Timestamp{100ms});
  EXPECT_EQ(samples[50].stamp, Timestamp{5s + 100ms + 250us});
  EXPECT_EQ(samples[100].stamp, Timestamp{10s + 100ms + 500us + 1s});
}
}  // namespace
}  // namespace scanloom::simulated_imu_unittest
