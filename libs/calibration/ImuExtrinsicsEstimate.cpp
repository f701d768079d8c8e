#include "calibration/ImuExtrinsicsEstimate.h"

#include "base/core/Angle.h"
#include "base/core/Decompositions.h"
#include "estimation/imu/GyroAgreement.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr std::size_t kFewestPoses = 50, kMostPoses = 1500;
constexpr PoseNoise kFirstNoise{0.005, 0.05 * kDegree};
constexpr double kLeastExtent = 2;                      // m: on the spot, errors of 4 deg looked certain to 0.6 deg
constexpr double kMostMisfit = 3;                       // standard deviations
constexpr PoseNoise kMostResidual{0.1, 1.0 * kDegree};  // registrations are ten times better
constexpr double kLeastTurn = 0.5 * kDegree;            // rad/s
// What simulated drives have in common, beyond the scatter within each.
constexpr double kCommonImuOffset = 0.01, kCommonTurn = 0.02 * kDegree, kCommonClock = 3e-4;  // m, rad, s

std::vector<BodyTurn> turnsOf(const Trajectory& poses)
{
  constexpr Duration kLongest = 250ms;
  constexpr double kFastest = 1.5;  // rad/s: a faster one is a wrong pose
  std::vector<BodyTurn> turns;
  for (std::size_t i = 1; i < poses.size(); ++i)
  {
    const StampedPose &from = poses[i - 1], &to = poses[i];
    const Eigen::Vector3d turn = logSo3(from.map_T_body.rotation.conjugate() * to.map_T_body.rotation);
    const bool usual = to.stamp - from.stamp <= kLongest && turn.norm() < kFastest * seconds(to.stamp - from.stamp);
    if (usual) turns.push_back({from.stamp, to.stamp, turn});
  }
  return turns;
}

/** Those that the samples cover whatever the delay, and not too many. */
Trajectory covered(const Trajectory& all, const std::vector<ImuSample>& samples)
{
  constexpr Duration kMargin = 600ms;
  Trajectory poses, some;
  for (const StampedPose& pose : all)
    if (!samples.empty() && pose.stamp > samples.front().stamp + kMargin && pose.stamp < samples.back().stamp - kMargin)
      poses.push_back(pose);
  const std::size_t every_nth = 1 + poses.size() / kMostPoses;
  for (std::size_t i = 0; i < poses.size(); i += every_nth) some.push_back(poses[i]);
  return some;
}

/** Diagonal of the box that the poses fill (m). */
double extentOf(const Trajectory& poses)
{
  Eigen::AlignedBox3d box;
  for (const StampedPose& pose : poses) box.extend(pose.map_T_body.translation);
  return box.diagonal().norm();
}

/** Along the body's axes, in metres. */
Matrix7d covarianceOf(const ImuExtrinsicsSolution& s)
{
  Matrix7d turn = Matrix7d::Identity();
  turn.topLeftCorner<3, 3>() = turn.block<3, 3>(3, 3) = s.extrinsics.body_T_sensor.rotation.toRotationMatrix();
  Matrix7d covariance = turn * sandwich(s.information, s.gradients, Clock::Estimated) * turn.transpose();
  Vector7d common;
  common << Eigen::Vector3d::Constant(kCommonImuOffset), Eigen::Vector3d::Constant(kCommonTurn), kCommonClock;
  covariance.diagonal() += common.cwiseQuotient(extrinsicsStepOfMetres()).cwiseAbs2();
  return covariance;
}

bool fits(const ImuExtrinsicsSolution& s)
{
  return s.motion_misfit < kMostMisfit && s.residual.position < kMostResidual.position &&
         s.residual.rotation < kMostResidual.rotation;
}

/** Of the body, about the axis about which it turned second most: rad/s, root mean square. */
double secondTurnRate(const Trajectory& poses)
{
  constexpr Duration kLong = 500ms, kTooLong = 1s;  // so that noise of the poses counts little
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double turns = 0;
  for (std::size_t from = 0, to = 0; to < poses.size(); ++to)
  {
    const Duration between = poses[to].stamp - poses[from].stamp;
    if (between < kLong) continue;
    const Eigen::Vector3d turn = logSo3(poses[from].map_T_body.rotation.conjugate() * poses[to].map_T_body.rotation);
    from = to;
    if (between > kTooLong) continue;
    sum += (turn / seconds(between)) * (turn / seconds(between)).transpose();
    ++turns;
  }
  return std::sqrt(eigensystem3(sum / std::max(1.0, turns)).values[1]);
}
}  // namespace

bool hasNumbers(const ImuExtrinsicsEstimate& estimate)
{
  return estimate.outcome == ImuExtrinsicsOutcome::Estimated || estimate.outcome == ImuExtrinsicsOutcome::Open;
}

std::optional<Extrinsics> imuExtrinsicsByTurns(const Trajectory& poses, const std::vector<ImuSample>& samples,
                                               const Extrinsics& given)
{
  constexpr double kLeastScale = 0.8;
  const std::optional<GyroAgreement> agreement = gyroAgreement(turnsOf(poses), {samples, given.body_T_sensor});
  if (!agreement || agreement->mirrored || agreement->scale < kLeastScale || agreement->scale > 1 / kLeastScale)
    return std::nullopt;
  return Extrinsics{
      {(expSo3(agreement->rotation) * given.body_T_sensor.rotation).normalized(), given.body_T_sensor.translation},
      seconds(agreement->lag)};
}

ImuExtrinsicsEstimate withoutImuExtrinsics(const Trajectory& poses, const Extrinsics& given)
{
  ImuExtrinsicsEstimate estimate;
  estimate.extrinsics = estimate.by_drive = given;
  estimate.poses = poses.size();
  if (secondTurnRate(poses) > kLeastTurn) estimate.outcome = ImuExtrinsicsOutcome::Contradicted;
  return estimate;
}

ImuExtrinsicsEstimate estimateImuExtrinsics(const Trajectory& all, const std::vector<ImuSample>& samples,
                                            const Extrinsics& given, const Extrinsics& start, const ImuNoise& noise)
{
  ImuExtrinsicsEstimate estimate;
  estimate.extrinsics = estimate.by_drive = given;
  const Trajectory poses = covered(all, samples);
  estimate.poses = poses.size();
  if (poses.size() < kFewestPoses || extentOf(poses) < kLeastExtent) return estimate;

  ImuExtrinsicsSolution s = solveImuExtrinsics(poses, samples, start, noise, kFirstNoise);
  if (fits(s)) s = solveImuExtrinsics(poses, samples, s.extrinsics, noise, s.residual);
  estimate.residual = s.residual;
  estimate.misfit = s.motion_misfit;
  estimate.outcome = ImuExtrinsicsOutcome::Contradicted;
  if (!fits(s)) return estimate;
  static_cast<ObservableExtrinsics&>(estimate) = observableExtrinsics(given, s.extrinsics, covarianceOf(s), kOpenImu);
  estimate.outcome = estimate.open.empty() ? ImuExtrinsicsOutcome::Estimated : ImuExtrinsicsOutcome::Open;
  estimate.by_drive = s.extrinsics;
  return estimate;
}
}  // namespace scanloom
