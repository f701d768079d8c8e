/** The objective of D2D NDT over many stations with one pose and one clock offset for all. */
#pragma once
#include "base/core/Rigid.h"
#include "estimation/ndt/CellCorrespondences.h"

#include <vector>

namespace scanloom
{
using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;

/** To compare: rotations as the motion of a point at 5 m, clocks as that of a body at 1 m/s. */
Vector7d extrinsicsStepOfMetres();

/** How the lidar's points move from where its assumed extrinsics put them. */
struct ExtrinsicsCorrection
{
  Rigid pose;        // body_T_body'
  double clock = 0;  // s, to be added to the clock offset
};

/** Step: translation and rotation as in boxPlus(pose, step), then the clock. */
ExtrinsicsCorrection corrected(const ExtrinsicsCorrection&, const Vector7d& step);

struct ExtrinsicsEquations
{
  double value = 0;  // as in NormalEquations, sums over all stations
  double met_points = 0;
  Vector7d gradient = Vector7d::Zero();
  Matrix7d curvature = Matrix7d::Zero();
  std::vector<Vector7d> gradients;  // by station
};

/**
 * At a stamp that is late by c the body was at exp(-c twist), so a station's points are moved by exp(-c twist) pose; by
 * the chain rule the derivative by c is that by the pose along -Ad(pose^-1) twist (T. Barfoot: State Estimation for
 * Robotics, 2017, eq. (7.38)). `twists` by station, in the body frame.
 */
ExtrinsicsEquations extrinsicsEquations(std::vector<CellCorrespondences>&, const std::vector<Vector6d>& twists,
                                        const ExtrinsicsCorrection&, double d2);

enum class Clock
{
  Kept,
  Estimated,
};

struct ExtrinsicsMinimum
{
  ExtrinsicsCorrection correction;
  ExtrinsicsEquations equations;
  bool converged = false;
};

/** Damped Gauss-Newton from no correction. */
ExtrinsicsMinimum minimiseExtrinsics(std::vector<CellCorrespondences>&, const std::vector<Vector6d>& twists, Clock,
                                     double d2);

/** Derivative of the gradient, by central differences of 2 mm. In metres (extrinsicsStepOfMetres), symmetric. */
Matrix7d hessianOf(std::vector<CellCorrespondences>&, const std::vector<Vector6d>& twists, const ExtrinsicsCorrection&,
                   double d2);
}  // namespace scanloom
