/** Poses of a drive's keyframes relative to each other, as `slam` has them. */
#pragma once
#include "estimation/graph/PoseGraph.h"
#include "site/SiteDrive.h"

#include <vector>

namespace scanloom
{
/**
 * Edges of a pose graph from each keyframe to the three before it, each with three times the covariance with which it
 * was aligned to the local map: so errors of keyframes average, as they do in that map, and grow as a random walk. With
 * more edges the graph would claim less drift than simulated drives have (doc/study/site.md). None goes across the
 * beginning of a part. `first`: number of the drive's first keyframe in the graph.
 */
std::vector<OdometryPose> odometryOf(const std::vector<DriveKeyframe>&, std::size_t first);

/** Which way is up for each keyframe. Errors last for some keyframes: each one counts as a tenth. */
std::vector<MeasuredUp> upsOf(const std::vector<DriveKeyframe>&, std::size_t first);

/** How far a drive's odometry may be off between two of its keyframes of one part. */
class OdometryDrift
{
 public:
  explicit OdometryDrift(const std::vector<DriveKeyframe>&);

  /** m, standard deviation. */
  double between(std::size_t a, std::size_t b) const;

  /** m, length of the way. */
  double way(std::size_t a, std::size_t b) const;

 private:
  std::vector<double> way_, position_, heading_;  // sums from the first keyframe on: m, m2, rad2
};
}  // namespace scanloom
