#include "calibration/internal/ExtrinsicsCovariance.h"

#include "base/core/Decompositions.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr std::size_t kBlocks = 20;
constexpr double kUntold = 10;                                        // m
constexpr double kOpenClock = 0.005;                                  // s
constexpr double kFlat = 1e-4;                                        // of the largest curvature
constexpr double kCommonOffset = 0.002, kCommonOffsetOnAxes = 0.008;  // m
constexpr double kCommonShare = 0.045, kCommonShareAtRest = 0.06;     // of the distance of surfaces
constexpr double kCommonArm = 10;                                     // m: the same error as a turn is this much less

/** The expectation of a scatter's inverse is larger than that of few blocks shows (Hotelling's T2). */
Matrix7d scatterOf(const std::vector<Vector7d>& gradients, int numbers)
{
  const std::size_t blocks = std::min(kBlocks, gradients.size());
  Vector7d mean = Vector7d::Zero();
  std::vector<Vector7d> sums(blocks, Vector7d::Zero());
  for (std::size_t i = 0; i < gradients.size(); ++i) sums[i * blocks / gradients.size()] += gradients[i];
  for (const Vector7d& sum : sums) mean += sum / static_cast<double>(blocks);
  Matrix7d scatter = Matrix7d::Zero();
  for (const Vector7d& sum : sums) scatter += (sum - mean) * (sum - mean).transpose();
  const auto n = static_cast<double>(blocks);
  return scatter * n / std::max(1.0, n - numbers - 2);
}

void withoutClock(Matrix7d& matrix)
{
  matrix.row(6).setZero();
  matrix.col(6).setZero();
}

/** From corrections about the body's origin to errors at the sensor, both in metres. */
Matrix7d atSensor(const Eigen::Vector3d& sensor)
{
  Matrix7d at_sensor = Matrix7d::Identity();
  at_sensor.block<3, 3>(0, 3) = -skew(sensor);
  const Vector7d scale = extrinsicsStepOfMetres();
  return scale.cwiseInverse().asDiagonal() * at_sensor * scale.asDiagonal();
}

/** How the pose follows the clock: both in metres, per metre of the clock. */
Vector7d changeWithClock(const Matrix7d& hessian)
{
  Vector7d change;
  change << -solveSymmetric(hessian.topLeftCorner<6, 6>(), hessian.topRightCorner<6, 1>()), 1;
  return change;
}

/** What all stations, or all cells of one instant, have in common. */
void addCommon(Matrix7d& covariance, double offset)
{
  Vector7d common;
  common << Eigen::Vector3d::Constant(offset), Eigen::Vector3d::Constant(offset / kCommonArm), 0;
  covariance.diagonal() += common.cwiseQuotient(extrinsicsStepOfMetres()).cwiseAbs2();
}

/** Of the pose, and the clock by itself: mixed with the pose it would be judged by the pose's limit. */
std::vector<OpenDirection> openDirections(const Matrix7d& covariance, double limit)
{
  std::vector<OpenDirection> open;
  const Eigensystem6 of_pose = eigensystem(covariance.topLeftCorner<6, 6>());
  for (int i = 5; i >= 0; --i)
  {
    const double sigma = std::sqrt(std::max(0.0, of_pose.values[i]));
    Vector7d direction;
    direction << of_pose.vectors.col(i), 0;
    if (sigma > limit) open.push_back({direction, sigma});
  }
  const double of_clock = std::sqrt(covariance(6, 6));
  if (of_clock > kOpenClock) open.push_back({Vector7d::Unit(6), of_clock});
  return open;
}

/** The estimate without what it says along the open directions. */
Extrinsics keepingOpen(const Extrinsics& start, const Extrinsics& estimate, const std::vector<OpenDirection>& open)
{
  Vector7d metres = changeInMetres(start, estimate);
  for (const OpenDirection& o : open) metres -= o.direction * o.direction.dot(metres);
  const Vector7d change = metres.cwiseProduct(extrinsicsStepOfMetres());
  const Rigid& from = start.body_T_sensor;
  Extrinsics kept;
  kept.body_T_sensor.translation = from.translation + change.head<3>();
  kept.body_T_sensor.rotation = (expSo3(change.segment<3>(3)) * from.rotation).normalized();
  kept.clock_offset = start.clock_offset + change[6];
  return kept;
}
}  // namespace

Matrix7d sandwich(const Matrix7d& hessian, const std::vector<Vector7d>& gradients, Clock clock)
{
  const auto [curvatures, directions] = eigensystem7(hessian);
  Matrix7d inverse = Matrix7d::Zero(), untold = Matrix7d::Zero();
  for (int i = 0; i < 7; ++i)
  {
    const Vector7d direction = directions.col(i);
    if (curvatures[i] > kFlat * curvatures[6])
      inverse += direction * direction.transpose() / curvatures[i];
    else
      untold += kUntold * kUntold * direction * direction.transpose();
  }
  const Matrix7d scatter = scatterOf(gradients, clock == Clock::Kept ? 6 : 7);
  return inverse * scatter * inverse + untold;
}

double commonOffset(double surface_distance, Stems stems)
{
  return std::max(stems == Stems::OnAxes ? kCommonOffsetOnAxes : kCommonOffset, kCommonShare * surface_distance);
}

Matrix7d sandwichOfExtrinsics(const Matrix7d& all, const std::vector<Vector7d>& gradients, Clock clock)
{
  Matrix7d hessian = all;
  if (clock == Clock::Kept) withoutClock(hessian);
  std::vector<Vector7d> in_metres;
  for (const Vector7d& gradient : gradients) in_metres.emplace_back(extrinsicsStepOfMetres().cwiseProduct(gradient));
  Matrix7d covariance = sandwich(hessian, in_metres, clock);
  if (clock == Clock::Kept) withoutClock(covariance);
  return covariance;
}

Matrix7d extrinsicsCovariance(const Matrix7d& hessian, const std::vector<Vector7d>& gradients, double clock_deviation,
                              const Eigen::Vector3d& sensor_in_body, double common_offset)
{
  const Matrix7d at_sensor = atSensor(sensor_in_body);
  const Vector7d with_clock = clock_deviation * changeWithClock(hessian);
  Matrix7d covariance = sandwichOfExtrinsics(hessian, gradients, Clock::Kept) + with_clock * with_clock.transpose();
  covariance = at_sensor * covariance * at_sensor.transpose();
  addCommon(covariance, common_offset);
  return covariance;
}

Matrix7d extrinsicsCovariance(const Matrix6d& of_correction, const Rigid& correction,
                              const Eigen::Vector3d& sensor_in_body, double surface_distance)
{
  const Vector7d to_metres = extrinsicsStepOfMetres().cwiseInverse();
  Matrix7d along_body = Matrix7d::Identity();
  along_body.topLeftCorner<3, 3>() = along_body.block<3, 3>(3, 3) = correction.rotation.toRotationMatrix();
  Matrix7d covariance = Matrix7d::Zero();
  covariance.topLeftCorner<6, 6>() = of_correction;
  const Matrix7d at_sensor = atSensor(sensor_in_body) * along_body * to_metres.asDiagonal();
  covariance = at_sensor * covariance * at_sensor.transpose();
  addCommon(covariance, std::max(kCommonOffset, kCommonShareAtRest * surface_distance));
  return covariance;
}

Vector7d changeInMetres(const Extrinsics& from, const Extrinsics& to)
{
  const Rigid &a = from.body_T_sensor, &b = to.body_T_sensor;
  Vector7d change;
  change << b.translation - a.translation, logSo3(b.rotation * a.rotation.conjugate()),
      to.clock_offset - from.clock_offset;
  return change.cwiseQuotient(extrinsicsStepOfMetres());
}

ObservableExtrinsics observableExtrinsics(const Extrinsics& given, const Extrinsics& estimate,
                                          const Matrix7d& covariance, double limit)
{
  ObservableExtrinsics observable;
  observable.open = openDirections(covariance, limit);
  observable.extrinsics = keepingOpen(given, estimate, observable.open);
  const Vector7d scale = extrinsicsStepOfMetres();
  observable.covariance = scale.asDiagonal() * covariance * scale.asDiagonal();
  return observable;
}
}  // namespace scanloom
