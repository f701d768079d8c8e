/** Covariance of a registered pose by its matched cells, and the directions that they leave open. */
#pragma once
#include "estimation/ndt/CellCorrespondences.h"

#include <vector>

namespace scanloom
{
/** To compare rotations with translations, a rotation counts as the motion of a point at this distance. */
constexpr double kArm = 5.0;  // m

/** (1, 1, 1, 1/kArm, ...): times a step in metres it is a step in the tangent of boxPlus. */
Vector6d stepOfMetres();

/** Square root of a covariance's largest eigenvalue, in metres (see stepOfMetres). */
double largestDeviation(const Matrix6d& covariance);

/** Orthonormal steps in metres along which a covariance is larger than that of degenerate directions. */
std::vector<Vector6d> unmeasuredDirections(const Matrix6d& covariance);

/** Factor from information to the units of the score's curvature, as it is while each cell matches one that agrees. */
double scorePerInformation(double d2);

struct LidarInformation
{
  Matrix6d covariance = Matrix6d::Zero();   // with floor; 10 m along the degenerate directions
  std::vector<Vector6d> degenerate;         // as by degenerateDirections
  Eigen::Vector3d viewpoint_bias{0, 0, 0};  // see RegistrationResult
  /** As in NormalEquations, but the curvature is the second derivative of the score with B held: it may be indefinite.
   */
  Vector6d gradient = Vector6d::Zero();
  Matrix6d curvature = Matrix6d::Zero();
};

/** Orthonormal steps in metres that no structure resists. The correspondences must have been moved to the pose. */
std::vector<Vector6d> degenerateDirections(const CellCorrespondences&, const Rigid& target_T_source, double d2);

/** The correspondences must have been moved to the pose. */
LidarInformation lidarInformation(const CellCorrespondences&, const Rigid& target_T_source, double d2);
}  // namespace scanloom
