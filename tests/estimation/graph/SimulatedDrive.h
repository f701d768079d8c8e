#pragma once
#include "estimation/graph/FixedLagSmoother.h"
#include "estimation/imu/AnalyticDrive.h"

#include <vector>

namespace scanloom
{
/** What a run of the analytic drive gave: noisy motions between scans, a noisy lidar pose at each, and the truth. */
struct SimulatedDrive
{
  std::vector<NavState> truth;          // at the scans' ends, with the walking biases
  std::vector<Preintegration> motions;  // motions[k] leads from truth[k] to truth[k + 1], linearised at the first guess
  std::vector<Rigid> map_T_body;        // measured; map_T_body[k] is of truth[k]
  NavState first_guess;                 // truth[0] with an error from first_covariance
  Matrix15d first_covariance;
  Matrix6d information;  // of each measured pose
};

struct DriveNoise
{
  ImuNoise imu{0.05, 2e-3, 5e-3, 1e-3};
  double pose = 0.02;        // m
  double pose_angle = 2e-3;  // rad
  double share = 1;          // all errors drawn are multiplied by it
};

inline SimulatedDrive simulate(const AnalyticDrive& drive, int scans, Duration period, const DriveNoise& noise,
                               unsigned seed)
{
  constexpr Duration kImuPeriod = 5ms;
  Noise random(seed);
  const auto draw = [&](double sigma) -> Eigen::Vector3d { return noise.share * random.normal<3>(sigma); };
  const double root = std::sqrt(seconds(kImuPeriod));

  SimulatedDrive run;
  Vector15d sigma;
  sigma << Eigen::Vector3d::Constant(0.05), Eigen::Vector3d::Constant(0.01), Eigen::Vector3d::Constant(0.1),
      Eigen::Vector3d::Constant(2e-3), Eigen::Vector3d::Constant(0.05);
  run.first_covariance = sigma.cwiseAbs2().asDiagonal();
  run.information.setZero();
  run.information.diagonal() << Eigen::Vector3d::Constant(1 / (noise.pose * noise.pose)),
      Eigen::Vector3d::Constant(1 / (noise.pose_angle * noise.pose_angle));

  ImuBias bias{draw(2e-3), draw(0.05)};
  Timestamp stamp{1s};
  run.truth.push_back(drive.stateAt(stamp, bias));
  const Vector15d error = noise.share * sigma.cwiseProduct(random.normal<15>(1));
  run.first_guess = boxPlus(run.truth.front(), -error);
  for (int k = 1; k < scans; ++k)
  {
    std::vector<ImuSample> samples = drive.samples(stamp, stamp + period, kImuPeriod);
    for (ImuSample& s : samples)
    {
      s.gyro += bias.gyro + draw(noise.imu.gyro_noise_deg * M_PI / 180 / root);
      s.accel += bias.accel + draw(noise.imu.accel_noise / root);
    }
    run.motions.push_back(preintegrate(std::move(samples), run.first_guess.bias, noise.imu));

    const double root_period = std::sqrt(seconds(period));
    bias.gyro += draw(noise.imu.gyro_bias_walk_deg * M_PI / 180 * root_period);
    bias.accel += draw(noise.imu.accel_bias_walk * root_period);
    stamp += period;
    run.truth.push_back(drive.stateAt(stamp, bias));
  }
  for (const NavState& state : run.truth)
  {
    Vector6d step;
    step << draw(noise.pose), draw(noise.pose_angle);
    run.map_T_body.push_back(boxPlus(state.map_T_imu * kBodyFromImu.inverse(), step));
  }
  return run;
}

inline FixedLagSmoother smootherFor(const SimulatedDrive& run, const DriveNoise& noise, const SmootherOptions& options)
{
  return {run.first_guess, run.first_covariance, kBodyFromImu, noise.imu, options};
}

/** Feeds scan k, whose motion leads to it. */
inline void feed(FixedLagSmoother& smoother, const SimulatedDrive& run, std::size_t k)
{
  smoother.addState(run.motions[k - 1]);
  smoother.addPosePrior(run.map_T_body[k], run.information);
}
}  // namespace scanloom
