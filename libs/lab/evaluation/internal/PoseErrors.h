/** Absolute and relative pose errors, as evo 1.x defines them (evo_ape, evo_rpe: translation_part, angle_deg,
 * point_distance). */
#pragma once
#include "base/positions/Alignment.h"

#include <optional>
#include <vector>

namespace scanloom
{
struct PosePair
{
  Rigid map_T_body;        // by the estimate
  Rigid reference_T_body;  // by the reference
};

/**
 * Poses of a point of the body, with the orientation of the body, at the estimate's stamps. The reference is
 * interpolated to them (evo takes its nearest pose within 10 ms).
 */
std::vector<PosePair> posePairs(const Trajectory& estimate, const Eigen::Vector3d& body_p_point,
                                const Trajectory& reference);

struct ErrorSize
{
  double rmse = 0, largest = 0;  // root mean square and largest value
};

struct PoseErrors
{
  ErrorSize metres;
  std::optional<ErrorSize> degrees;  // none: only positions are known
  std::size_t compared = 0;          // number of poses, or of pairs of poses
};

/** APE: reference^-1 * estimate, after an alignment on all pairs. Throws std::invalid_argument if there are no pairs.
 */
PoseErrors absoluteErrors(const std::vector<PosePair>&, AlignmentKind);
PoseErrors absoluteErrors(const std::vector<PositionPair>&, AlignmentKind);

/**
 * RPE: (reference_i^-1 reference_j)^-1 (estimate_i^-1 estimate_j) for i and j that are 1 m of the estimate's path
 * apart, j being the next i. As in evo, the first i is where the path reaches 1 m. On a shorter path nothing is
 * compared.
 */
PoseErrors relativeErrors(const std::vector<PosePair>&);

/** With positions only: the difference of the distances from i to j (evo's point_distance). */
PoseErrors relativeErrors(const std::vector<PositionPair>&);
}  // namespace scanloom
