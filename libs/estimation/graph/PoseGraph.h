/**
 * A pose graph of keyframes: their poses relative to each other, gravity, and positions that others have measured,
 * solved in one go. What may be wrong is weighed by graduated non-convexity (H. Yang et al.: Graduated Non-Convexity
 * for Robust Spatial Perception, RA-L 2020): a few false loops or positions do not move the result.
 */
#pragma once
#include "base/core/Rigid.h"

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

namespace scanloom
{
struct RelativePose
{
  std::size_t from = 0, to = 0;  // indices of poses
  Rigid from_T_to;
  Matrix6d covariance;  // of boxMinus(truth, from_T_to)
};

/**
 * By an odometry that errs alike through a drive: all motions are too short by a share of their length, and lead down
 * by another share. Both are estimated for each drive.
 */
struct OdometryPose : RelativePose
{
  std::size_t drive = 0;
  Eigen::Vector3d from_up;  // which way is up in the frame `from`
};

/** Which way is up, as a pose's keyframe has it from an accelerometer. */
struct MeasuredUp
{
  std::size_t pose = 0;
  Eigen::Vector3d body_up;  // unit vector
  double sigma = 0;         // rad, of each of the two angles
};

/** Position of a point that is fixed to a keyframe's body, in the frame of the graph. */
struct MeasuredPosition
{
  std::size_t pose = 0;
  Eigen::Vector3d body_p_point;
  Eigen::Vector3d map_p_point;
  Eigen::Matrix3d covariance;  // m2
  double share = 1;            // that it counts: positions whose errors last count as one together
};

struct PoseGraph
{
  std::vector<Rigid> map_T_body;       // from where the search begins
  std::vector<OdometryPose> odometry;  // right, within their covariances
  double scale_sigma = 0;              // standard deviation of both shares
  std::vector<RelativePose> loops;     // each may be wrong
  std::vector<MeasuredUp> ups;
  std::vector<MeasuredPosition> positions;  // each may be wrong
  std::optional<std::size_t> fixed;         // keeps its place and heading; none: positions hold the graph
};

struct SolvedPoseGraph
{
  std::vector<Rigid> map_T_body;
  std::vector<bool> loops_used, positions_used;
  std::vector<double> loop_distances, position_distances;  // in standard deviations, of all, used or not
};

/** Nothing holds the graph in its place: there is no fixed pose, and all positions are refused. */
struct UnheldPoseGraph : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/**
 * One thread; the same graph gives the same bits. Throws std::invalid_argument for an index without a pose or a
 * covariance that is not positive definite, and UnheldPoseGraph.
 */
SolvedPoseGraph solved(const PoseGraph&);

/**
 * Of boxMinus(truth, map_T_body) for each pose of a solved graph, in which all loops and positions count; of `fixed`,
 * zero but for the tilt. The time grows with the square of the number of poses. Throws as solved().
 */
std::vector<Matrix6d> covariancesOf(const PoseGraph&);
}  // namespace scanloom
