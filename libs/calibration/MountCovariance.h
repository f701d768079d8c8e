/** How far a mount may be off, and what the drive did not tell of it. */
#pragma once
#include "calibration/Mount.h"
#include "calibration/MountEquations.h"

#include <vector>

namespace scanloom
{
/**
 * Covariance by the second derivative of a sum and the scatter of its terms' gradients in 20 blocks, in their order (P.
 * Huber, 1967), so that errors that neighbours have in common count once; 10 m along directions without curvature. All
 * in metres (mountStepOfMetres).
 */
Matrix7d sandwich(const Matrix7d& hessian, const std::vector<Vector7d>& gradients, Clock);

/**
 * Of the errors of the sensor's position, its rotation, both along the body's axes, and the clock, in metres
 * (mountStepOfMetres), by sandwich() of the stations' gradients. What all stations have in common is added, as
 * simulated drives show it: 4.5 % of the distance at which surfaces stay apart (surfaceDistance), at least 2 mm, with
 * stems on their axes 8 mm, and a turn of that at 10 m. Lidars see different sides of stems and leaves.
 * @param hessian as hessianOf() gives it.
 */
Matrix7d mountCovariance(const Matrix7d& hessian, const std::vector<Vector7d>& gradients, Clock,
                         const Eigen::Vector3d& sensor_in_body, double surface_distance, Stems);

/**
 * The same by a registration's covariance of the correction body_T_body' (RegistrationResult); without a clock. Of one
 * instant 6 % of the distance is in common.
 */
Matrix7d mountCovariance(const Matrix6d& of_correction, const Rigid& correction, const Eigen::Vector3d& sensor_in_body,
                         double surface_distance);

/** A combination of the seven numbers that the drive does not tell. */
struct OpenDirection
{
  Vector7d direction;  // unit, in metres as the covariance
  double sigma = 0;    // m
};

/** A tape measure tells as much (m). */
inline constexpr double kOpenLidar = 0.03, kOpenImu = 0.05;

/** With a standard deviation above `limit` (m), or 5 ms for the clock. */
std::vector<OpenDirection> openDirections(const Matrix7d& covariance, double limit);

/** Of position, rotation, both along the body's axes, and clock, in metres (mountStepOfMetres). */
Vector7d changeInMetres(const Mount& from, const Mount& to);

/** The estimate without what it says along the open directions. */
Mount keepingOpen(const Mount& start, const Mount& estimate, const std::vector<OpenDirection>&);
}  // namespace scanloom
