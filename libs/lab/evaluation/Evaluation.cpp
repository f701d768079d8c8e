#include "lab/evaluation/Evaluation.h"

#include "base/formats/Trajectory.h"
#include "base/positions/ClockOffset.h"

namespace scanloom
{
namespace
{
/** Compares estimates with one reference. */
class Comparison
{
 public:
  Comparison(const EvaluationOptions& options, PositionTrack reference)
    : options_(options), reference_(std::move(reference))
  {
  }

  std::vector<PositionPair> pairs(const Trajectory& estimate) const
  {
    std::vector<PositionPair> found = pairsAtReference(estimate, options_.body_p_point, reference_);
    if (found.empty()) throw shareNoTime(positionsOf(estimate), reference_);
    return found;
  }
  double coverage(const std::vector<PositionPair>& pairs) const { return scanloom::coverage(pairs, reference_); }
  Drift drift(const Trajectory& estimate) const { return driftOf(pairs(estimate), options_.alignment); }

 private:
  const EvaluationOptions& options_;
  PositionTrack reference_;
};

Trajectory atStampsOf(const Trajectory& estimate, const Trajectory& truth)
{
  Trajectory poses;
  for (const StampedPose& pose : estimate)
    if (const auto true_pose = poseAt(truth, pose.stamp)) poses.push_back({pose.stamp, *true_pose});
  return poses;
}

Trajectory earlier(Trajectory trajectory, Duration offset)
{
  for (StampedPose& pose : trajectory) pose.stamp -= offset;
  return trajectory;
}
}  // namespace

Evaluation evaluate(const EvaluationInput& input, const EvaluationOptions& options)
{
  std::optional<Trajectory> true_poses;
  if (const auto* poses = std::get_if<Trajectory>(&input.reference)) true_poses = *poses;
  PositionTrack reference =
      true_poses ? positionsOf(*true_poses, options.body_p_point) : std::get<PositionTrack>(input.reference);

  Evaluation evaluation;
  evaluation.clock_offset =
      clockOffset(input.imu_rate ? *input.imu_rate : input.scans, options.body_p_point, reference);
  if (options.apply_clock_offset && evaluation.clock_offset)
  {
    evaluation.clock_offset_applied = true;
    reference = earlier(std::move(reference), *evaluation.clock_offset);
    if (true_poses) true_poses = earlier(std::move(*true_poses), *evaluation.clock_offset);
  }

  const std::size_t samples = reference.size();
  const Comparison comparison(options, std::move(reference));
  evaluation.pairs = comparison.pairs(input.scans);
  evaluation.left_out = samples - evaluation.pairs.size();
  evaluation.covered = comparison.coverage(evaluation.pairs);
  evaluation.drift = driftOf(evaluation.pairs, options.alignment);
  if (input.imu_rate) evaluation.imu_rate_drift = comparison.drift(*input.imu_rate);
  if (const auto& truth = input.truth ? input.truth : true_poses)
    evaluation.floor = comparison.drift(atStampsOf(input.scans, *truth));

  if (true_poses)
  {
    const std::vector<PosePair> at_scans = posePairs(input.scans, options.body_p_point, *true_poses);
    evaluation.absolute = absoluteErrors(at_scans, options.alignment);
    evaluation.relative = relativeErrors(at_scans);
  }
  else
  {
    evaluation.absolute = absoluteErrors(evaluation.pairs, options.alignment);
    evaluation.relative = relativeErrors(evaluation.pairs);
  }
  return evaluation;
}
}  // namespace scanloom
