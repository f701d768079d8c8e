#include "simulation/SimulatedImu.h"

#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kRadians = M_PI / 180;

Eigen::Vector3d normalVector(Random& random)
{
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return {x, y, z};
}
}  // namespace

ImuSample idealImuSample(const Motion& body, const Rigid& body_T_imu, Timestamp stamp)
{
  // Rigid body: the IMU's acceleration is the origin's, plus what turning about it adds over the lever arm.
  const Eigen::Vector3d& arm = body_T_imu.translation;
  const Eigen::Vector3d origin_force =
      body.world_T_body.rotation.conjugate() * (body.acceleration - gravityInMap()).eval();
  const Eigen::Vector3d force =
      origin_force + body.angular_acceleration.cross(arm) + body.angular_rate.cross(body.angular_rate.cross(arm));
  const Eigen::Quaterniond imu_R_body = body_T_imu.rotation.conjugate();
  return {stamp, imu_R_body * body.angular_rate, imu_R_body * force};
}

std::vector<ImuSample> simulateImu(const Drive& drive, const RecordingSpan& span, const Rigid& body_T_imu,
                                   Timestamp first, Duration period, const ImuErrors& errors, std::uint64_t seed,
                                   RandomStream stream)
{
  const double step = seconds(period);
  const double gyro_deviation = errors.noise.gyro_noise_deg * kRadians / std::sqrt(step);
  const double accel_deviation = errors.noise.accel_noise / std::sqrt(step);
  const double gyro_walk = errors.noise.gyro_bias_walk_deg * kRadians * std::sqrt(step);
  const double accel_walk = errors.noise.accel_bias_walk * std::sqrt(step);

  std::vector<ImuSample> samples;
  ImuBias bias = errors.bias;
  for (Timestamp stamp = first; span.secondsAt(stamp) < span.duration; stamp += period)
  {
    Random random(seed, stream, samples.size());
    ImuSample sample = idealImuSample(drive.at(span.secondsAt(stamp)), body_T_imu, stamp);
    sample.gyro += bias.gyro + gyro_deviation * normalVector(random);
    sample.accel += bias.accel + accel_deviation * normalVector(random);
    samples.push_back(sample);
    bias.gyro += gyro_walk * normalVector(random);
    bias.accel += accel_walk * normalVector(random);
  }
  return samples;
}
}  // namespace scanloom
