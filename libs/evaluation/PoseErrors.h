/** Absolute and relative pose errors as evo 1.x defines them (evo_ape, evo_rpe: translation_part, angle_deg,
 * point_distance). */
#pragma once
#include "evaluation/Alignment.h"

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
 * At the estimate's stamps, the reference interpolated to them (evo takes its nearest pose within 10 ms); both of a
 * point of the body, with the body's orientation.
 */
std::vector<PosePair> posePairs(const Trajectory& estimate, const Eigen::Vector3d& body_p_point,
                                const Trajectory& reference);

/** Root mean squares and largest values. */
struct ErrorSize
{
  double rmse = 0, largest = 0;
};

struct PoseErrors
{
  ErrorSize metres;
  std::optional<ErrorSize> degrees;  // nothing where only positions are known
  std::size_t compared = 0;
};

/** APE: reference^-1 * estimate, once the estimate is aligned on all pairs. Throws std::invalid_argument without pairs.
 */
PoseErrors absoluteErrors(const std::vector<PosePair>&, AlignmentKind);
PoseErrors absoluteErrors(const std::vector<PositionPair>&, AlignmentKind);

enum class DeltaUnit
{
  Frames,
  Metres  // along the estimate
};
struct RelativeDelta
{
  double delta = 1;
  DeltaUnit unit = DeltaUnit::Metres;
};

/**
 * RPE: (reference_i^-1 reference_j)^-1 (estimate_i^-1 estimate_j) of consecutive pairs `delta` apart. As in evo the
 * first i is where the path first reaches `delta`. Nothing is compared if the path is shorter.
 */
PoseErrors relativeErrors(const std::vector<PosePair>&, const RelativeDelta&);

/** Of positions alone: by how much the distance from i to j differs (evo's point_distance). */
PoseErrors relativeErrors(const std::vector<PositionPair>&, const RelativeDelta&);
}  // namespace scanloom
