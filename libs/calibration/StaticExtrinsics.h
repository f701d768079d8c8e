/** Poses of lidars on the body by what all see at one instant, without motion. */
#pragma once
#include "calibration/ExtrinsicsEstimate.h"
#include "calibration/ExtrinsicsScene.h"
#include "calibration/ExtrinsicsSearch.h"

#include <vector>

namespace scanloom
{
/** A lidar's points (m, in its own frame), and its pose as far as it is known. */
struct StaticLidar
{
  std::vector<Eigen::Vector3f> points;
  Rigid body_T_sensor;
};

/**
 * By lidar; that of `reference` keeps its pose, and is not estimated. Start as findStart(), then D2D NDT with cells of
 * 2 m and 1 m, with the registration's own covariance and open directions (ndt/Registration.h). A lidar that is not
 * found by the reference is compared again with the reference and those found so far, until no more are found. Clocks
 * are not estimated. ExtrinsicsEstimate::stations is 1.
 */
std::vector<ExtrinsicsEstimate> estimateStaticExtrinsics(const std::vector<StaticLidar>&, std::size_t reference,
                                                         PoseGiven);

/** What two of them see: `lidar` as it was given, and at `after`. */
ExtrinsicsScene staticScene(const StaticLidar& reference, const StaticLidar& lidar, const Rigid& after);
}  // namespace scanloom
