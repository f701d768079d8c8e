#include "lab/evaluation/PositionError.h"

#include "base/formats/Trajectory.h"
#include "base/positions/PositionTrack.h"

#include <cmath>
#include <optional>

namespace scanloom
{
namespace
{
double lengthBetween(const Trajectory& reference, Timestamp from, Timestamp to)
{
  Eigen::Vector3d last = poseAt(reference, from)->translation;
  double length = 0;
  const auto advance = [&](const Eigen::Vector3d& position)
  {
    length += (position - last).norm();
    last = position;
  };
  for (const StampedPose& pose : reference)
    if (pose.stamp > from && pose.stamp < to) advance(pose.map_T_body.translation);
  advance(poseAt(reference, to)->translation);
  return length;
}
}  // namespace

PositionError positionErrorFromFirstPose(const Trajectory& estimate, const Trajectory& reference)
{
  PositionError error;
  std::optional<Rigid> map_T_reference;
  Timestamp first, last;
  double squares = 0;
  for (const StampedPose& pose : estimate)
  {
    const auto truth = poseAt(reference, pose.stamp);
    if (!truth) continue;
    if (!map_T_reference)
    {
      map_T_reference = pose.map_T_body * truth->inverse();
      first = pose.stamp;
    }
    error.final = (pose.map_T_body.translation - *map_T_reference * truth->translation).norm();
    squares += error.final * error.final;
    ++error.poses;
    last = pose.stamp;
    if (error.final >= error.largest)
    {
      error.largest = error.final;
      error.largest_at = pose.stamp;
    }
  }
  if (error.poses == 0) throw shareNoTime(positionsOf(estimate), positionsOf(reference));
  error.root_mean_square = std::sqrt(squares / static_cast<double>(error.poses));
  error.path_length = lengthBetween(reference, first, last);
  const PositionTrack positions = positionsOf(reference);
  error.covered = coverage(pairsAtReference(estimate, Eigen::Vector3d::Zero(), positions), positions);
  return error;
}
}  // namespace scanloom
