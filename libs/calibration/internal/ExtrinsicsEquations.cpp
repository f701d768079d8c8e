#include "calibration/internal/ExtrinsicsEquations.h"

#include "base/core/Decompositions.h"
#include "base/core/Interruption.h"
#include "estimation/ndt/LidarInformation.h"
#include "estimation/ndt/NormalEquations.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr int kMostSteps = 30;
constexpr double kTolerance = 5e-5;  // m
constexpr double kSlack = 0.005;     // the score may rise a little near the minimum (see ndt/Minimiser.cpp)
constexpr double kDifference = 2e-3;

/** Of a twist at the body's origin, as seen from the frame of `pose`. */
Vector6d twistIn(const Rigid& pose, const Vector6d& twist)
{
  const Eigen::Vector3d v = twist.head<3>(), w = twist.tail<3>();
  Vector6d seen;
  seen << pose.rotation.conjugate() * (v + w.cross(pose.translation)), pose.rotation.conjugate() * w;
  return seen;
}

/** In metres. */
Vector7d stepOf(const ExtrinsicsEquations& equations, double damping, Clock clock)
{
  const Vector7d scale = extrinsicsStepOfMetres();
  Matrix7d curvature = scale.asDiagonal() * equations.curvature * scale.asDiagonal();
  Vector7d gradient = scale.cwiseProduct(equations.gradient);
  if (clock == Clock::Kept)
  {
    curvature.row(6).setZero();
    curvature.col(6).setZero();
    gradient[6] = 0;
  }
  curvature.diagonal().array() += curvature.trace() * (damping + 1e-9);
  return -solveSymmetric(curvature, gradient);
}
}  // namespace

Vector7d extrinsicsStepOfMetres()
{
  Vector7d scale;
  scale << stepOfMetres(), 1;
  return scale;
}

ExtrinsicsCorrection corrected(const ExtrinsicsCorrection& correction, const Vector7d& step)
{
  return {boxPlus(correction.pose, step.head<6>()), correction.clock + step[6]};
}

ExtrinsicsEquations extrinsicsEquations(std::vector<CellCorrespondences>& stations, const std::vector<Vector6d>& twists,
                                        const ExtrinsicsCorrection& correction, double d2)
{
  ExtrinsicsEquations sum;
  for (std::size_t i = 0; i < stations.size(); ++i)
  {
    throwIfInterrupted();
    const Rigid pose = boxPlus(Rigid::identity(), -correction.clock * twists[i]) * correction.pose;
    const NormalEquations one = normalEquations(stations[i], pose, d2);
    Eigen::Matrix<double, 6, 7> step_of;
    step_of << Matrix6d::Identity(), -twistIn(correction.pose, twists[i]);
    sum.value += one.value;
    sum.met_points += one.met_points;
    sum.gradients.emplace_back(step_of.transpose() * one.gradient);
    sum.gradient += sum.gradients.back();
    sum.curvature += step_of.transpose() * one.curvature * step_of;
  }
  return sum;
}

ExtrinsicsMinimum minimiseExtrinsics(std::vector<CellCorrespondences>& stations, const std::vector<Vector6d>& twists,
                                     Clock clock, double d2)
{
  ExtrinsicsMinimum here;
  here.equations = extrinsicsEquations(stations, twists, here.correction, d2);
  double damping = 0;
  for (int i = 0; i < kMostSteps && here.equations.met_points > 0 && !here.converged; ++i)
  {
    const Vector7d step = stepOf(here.equations, damping, clock);
    const ExtrinsicsCorrection candidate = corrected(here.correction, extrinsicsStepOfMetres().cwiseProduct(step));
    ExtrinsicsEquations there = extrinsicsEquations(stations, twists, candidate, d2);
    if (there.value <= here.equations.value + kSlack * std::abs(here.equations.value))
    {
      here.correction = candidate;
      here.equations = std::move(there);
      here.converged = step.norm() < kTolerance;
      damping = damping > 1e-4 ? damping / 10 : 0;
    }
    else
      damping = std::max(10 * damping, 1e-3);
  }
  return here;
}

Matrix7d hessianOf(std::vector<CellCorrespondences>& stations, const std::vector<Vector6d>& twists,
                   const ExtrinsicsCorrection& correction, double d2)
{
  const Vector7d scale = extrinsicsStepOfMetres();
  Matrix7d hessian;
  for (int i = 0; i < 7; ++i)
  {
    const Vector7d step = scale.cwiseProduct(kDifference * Vector7d::Unit(i));
    const Vector7d above = extrinsicsEquations(stations, twists, corrected(correction, step), d2).gradient;
    const Vector7d below = extrinsicsEquations(stations, twists, corrected(correction, -step), d2).gradient;
    hessian.col(i) = scale.cwiseProduct(above - below) / (2 * kDifference);
  }
  return 0.5 * (hessian + hessian.transpose());
}
}  // namespace scanloom
