/** How far extrinsics may be off, and what the drive did not tell of it. */
#pragma once
#include "calibration/Extrinsics.h"
#include "calibration/internal/ExtrinsicsEquations.h"

#include <vector>

namespace scanloom
{
/**
 * Covariance by the second derivative of a sum and the scatter of its terms' gradients in 20 blocks, in their order (P.
 * Huber, 1967), so that errors that neighbours have in common count once; 10 m along directions without curvature. All
 * in metres (extrinsicsStepOfMetres).
 */
Matrix7d sandwich(const Matrix7d& hessian, const std::vector<Vector7d>& gradients, Clock);

/**
 * What all stations have in common (m), because lidars see different sides of stems and leaves, as simulated drives
 * show it: 4.5 % of the distance at which surfaces stay apart (surfaceDistance), at least 2 mm, with stems on their
 * axes 8 mm.
 */
double commonOffset(double surface_distance, Stems);

/**
 * Of the errors of the sensor's position, its rotation, both along the body's axes, and the clock, in metres
 * (extrinsicsStepOfMetres), by sandwich() of the stations' gradients while the clock is kept, by what an error of the
 * clock moves the pose, and by the offset that they have in common, with a turn of that at 10 m.
 * @param hessian as hessianOf() gives it.
 * @param clock_deviation in s; 0 for a clock that is not estimated.
 */
Matrix7d extrinsicsCovariance(const Matrix7d& hessian, const std::vector<Vector7d>& gradients, double clock_deviation,
                              const Eigen::Vector3d& sensor_in_body, double common_offset);

/** In metres, of stations' gradients (in the units of ExtrinsicsEquations). */
Matrix7d sandwichOfExtrinsics(const Matrix7d& hessian, const std::vector<Vector7d>& gradients, Clock);

/**
 * The same by a registration's covariance of the correction body_T_body' (RegistrationResult); without a clock. Of one
 * instant 6 % of the distance is in common.
 */
Matrix7d extrinsicsCovariance(const Matrix6d& of_correction, const Rigid& correction,
                              const Eigen::Vector3d& sensor_in_body, double surface_distance);

/** A combination of the seven numbers that the drive does not tell. */
struct OpenDirection
{
  Vector7d direction;  // unit, in metres as the covariance: of the pose, or of the clock alone
  double sigma = 0;    // m, or s

  bool isClock() const { return direction[6] != 0; }
};

/** A tape measure tells as much (m). */
inline constexpr double kOpenLidar = 0.03, kOpenImu = 0.05;

/** What a drive shows of extrinsics. */
struct ObservableExtrinsics
{
  Extrinsics extrinsics;  // open directions keep the given values
  /** Of the errors of position (m), rotation (rad), along the body's axes, and clock (s); zero if not estimated. */
  Matrix7d covariance = Matrix7d::Zero();
  std::vector<OpenDirection> open;
};

/**
 * By a covariance in metres (extrinsicsStepOfMetres). Directions with a standard deviation above `limit` (m), or 5 ms
 * for the clock, are open.
 */
ObservableExtrinsics observableExtrinsics(const Extrinsics& given, const Extrinsics& estimate,
                                          const Matrix7d& covariance, double limit);

/** Of position, rotation, both along the body's axes, and clock, in metres (extrinsicsStepOfMetres). */
Vector7d changeInMetres(const Extrinsics& from, const Extrinsics& to);
}  // namespace scanloom
