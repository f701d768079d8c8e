/** What the matched cells know about a pose, how surely, and what they cannot know. */
#pragma once
#include "ndt/Neighbourhoods.h"

#include <vector>

namespace scanloom
{
/** Rotations count as the way of a point at this distance, wherever they are compared with translations. */
constexpr double kArm = 5.0;  // m

/** diag(1, 1, 1, 1/kArm, ...): takes a step in metres to the tangent of boxPlus. */
Vector6d stepOfMetres();

/** Square root of a covariance's largest eigenvalue, in metres (see stepOfMetres). */
double largestDeviation(const Matrix6d& covariance);

/**
 * What the score's curvature is to the information that it stands for, while each cell meets one that agrees: takes
 * other information to the score's units.
 */
double scorePerInformation(double d2);

struct LidarInformation
{
  Matrix6d covariance = Matrix6d::Zero();  // sandwich with floor; kUnknownDeviation along the degenerate directions
  std::vector<Vector6d> degenerate;        // see degenerateDirections
};

/** The steps in metres that nothing resists, orthonormal. Neighbourhoods as for lidarInformation. */
std::vector<Vector6d> degenerateDirections(const Neighbourhoods&, const Rigid& target_T_source, double d2);

/** Neighbourhoods must have been moved to the pose. */
LidarInformation lidarInformation(const Neighbourhoods&, const Rigid& target_T_source, double d2);
}  // namespace scanloom
