#include "lab/simulation/internal/SimulatedImu.h"

#include "base/core/Angle.h"
#include "estimation/imu/Preintegration.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kSecondsPerHour = 3600;
constexpr double kInstantsPerSecond = 1600;  // that an IMU samples and averages (assumed)

Eigen::Vector3d normalVector(Random& random)
{
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return {x, y, z};
}
}  // namespace

ImuSample idealImuSample(const Motion& body, const Rigid& body_T_imu, Timestamp stamp)
{
  // Rigid body: acceleration of the origin, plus angular and centripetal acceleration over the lever arm.
  const Eigen::Vector3d& arm = body_T_imu.translation;
  const Eigen::Vector3d origin_force =
      body.world_T_body.rotation.conjugate() * (body.acceleration - gravityInMap()).eval();
  const Eigen::Vector3d force =
      origin_force + body.angular_acceleration.cross(arm) + body.angular_rate.cross(body.angular_rate.cross(arm));
  const Eigen::Quaterniond imu_R_body = body_T_imu.rotation.conjugate();
  return {stamp, imu_R_body * body.angular_rate, imu_R_body * force};
}

SimulatedImuOptions ousterLikeImu()
{
  SimulatedImuOptions options;
  options.rate = 100;
  options.gyro_noise_deg = 0.01;
  options.accel_noise = 1.77e-3;
  options.gyro_instability = 10;
  options.accel_instability = 1e-3;
  options.gyro_turn_on_deg = 0.3;
  options.accel_turn_on = 0.15;
  return options;
}

ImuStream::ImuStream(const Drive& drive, const RecordingSpan& span, const ImuSetup& setup, std::uint64_t seed)
  : drive_(drive), span_(span), setup_(setup), seed_(seed)
{
  Random random(seed, RandomStream::ImuBiases, static_cast<std::uint64_t>(setup.stream), setup.place);
  turn_on_.gyro = kDegree * setup.errors.gyro_turn_on_deg * normalVector(random);
  turn_on_.accel = setup.errors.accel_turn_on * normalVector(random);
  gyro_wander_ = kDegree / kSecondsPerHour * setup.errors.gyro_instability * normalVector(random);
  accel_wander_ = setup.errors.accel_instability * normalVector(random);
}

std::vector<ImuStream::Sample> ImuStream::before(Timestamp until)
{
  const auto due = [&] { return setup_.first + fromSeconds(static_cast<double>(index_) / setup_.errors.rate); };
  std::vector<Sample> samples;
  while (due() < std::min(until, span_.end())) samples.push_back(next());
  return samples;
}

ImuSample ImuStream::meanReading(Timestamp truth) const
{
  const double step = 1 / setup_.errors.rate;
  const int instants = std::max(1, static_cast<int>(std::lround(kInstantsPerSecond * step)));
  const Eigen::Quaterniond imu_R_body = setup_.body_T_imu.rotation.conjugate();
  ImuSample mean{truth, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (int i = 0; i < instants; ++i)
  {
    const double t = span_.secondsAt(truth) + ((i + 0.5) / instants - 0.5) * step;
    const ImuSample reading = idealImuSample(drive_.at(t), setup_.body_T_imu, truth);
    mean.gyro += reading.gyro / instants;
    mean.accel += reading.accel / instants;
    if (!setup_.mount.isStill()) mean.accel += imu_R_body * setup_.mount.accelerationAt(t) / instants;
  }
  return mean;
}

ImuStream::Sample ImuStream::next()
{
  const SimulatedImuOptions& errors = setup_.errors;
  const double step = 1 / errors.rate;
  const Timestamp truth = setup_.first + fromSeconds(static_cast<double>(index_) * step);
  Random random(seed_, setup_.stream, setup_.place, index_++);
  ImuSample reading = meanReading(truth);
  reading.stamp = setup_.clock.stamp(truth, span_.start);
  reading.gyro +=
      turn_on_.gyro + gyro_wander_ + kDegree * errors.gyro_noise_deg / std::sqrt(step) * normalVector(random);
  reading.accel += turn_on_.accel + accel_wander_ + errors.accel_noise / std::sqrt(step) * normalVector(random);

  // First-order Gauss-Markov process with constant standard deviation.
  const double kept = std::exp(-step / errors.correlation_time), driven = std::sqrt(1 - kept * kept);
  gyro_wander_ =
      kept * gyro_wander_ + driven * kDegree / kSecondsPerHour * errors.gyro_instability * normalVector(random);
  accel_wander_ = kept * accel_wander_ + driven * errors.accel_instability * normalVector(random);
  return {truth, reading};
}
}  // namespace scanloom
