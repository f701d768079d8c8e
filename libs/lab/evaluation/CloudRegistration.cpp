#include "lab/evaluation/CloudRegistration.h"

#include "base/core/Angle.h"

#include <array>
#include <chrono>

namespace scanloom
{
namespace
{
class Stopwatch
{
 public:
  double milliseconds() const
  {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Edges of the NDT cells, m, from coarse to fine. The source's finest are larger than the target's, as in the paper
// (2.5 m to 1 m), for less noisy means.
constexpr std::array<double, 4> kTargetLevels{8, 4, 2, 0.5}, kSourceLevels{8, 4, 2, 1};

/** Within half a metre and 5 deg two results are one. */
std::optional<PoseError> distanceIfFar(const Rigid& pose, const Rigid& other)
{
  constexpr double kMetres = 0.5, kDegrees = 5;
  const PoseError apart = poseError(pose, other);
  return apart.metres > kMetres || apart.degrees > kDegrees ? std::optional(apart) : std::nullopt;
}
}  // namespace

PoseError poseError(const Rigid& estimate, const Rigid& truth)
{
  const Vector6d e = boxMinus(estimate, truth);
  return {e.head<3>().norm(), e.tail<3>().norm() / kDegree};
}

PoseGuess guessWithin(const Rigid& pose, const PoseError& deviations)
{
  const double metres = deviations.metres, radians = deviations.degrees * M_PI / 180;
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(metres * metres), Eigen::Vector3d::Constant(radians * radians);
  return {pose, variances.asDiagonal()};
}

CloudPair::CloudPair(const Points& target, const Points& source)
  : target_(prepare(target, {kTargetLevels.begin(), kTargetLevels.end()})),
    source_(prepare(source, {kSourceLevels.begin(), kSourceLevels.end()}))
{
}

CloudPair::Prepared CloudPair::prepare(const Points& points, const std::vector<double>& levels)
{
  const Stopwatch stopwatch;
  std::vector<NdtMap> maps = ndtLevels(points, levels, NdtOptions{});
  return {std::move(maps), stopwatch.milliseconds()};
}

TimedRegistration CloudPair::registered(const PoseGuess& guess) const
{
  const Stopwatch stopwatch;
  const RegistrationResult result =
      alignCoarseToFine(pairLevels(target_.levels, source_.levels), guess, RegistrationOptions{});
  return {result, stopwatch.milliseconds()};
}

std::optional<PoseError> CloudPair::contradiction(const RegistrationResult& found, const Rigid& guess) const
{
  constexpr double kFew = 0.5, kAll = 0.99;  // overlaps
  if (found.overlap < kFew)
  {
    const RegistrationResult back = alignCoarseToFine(pairLevels(source_.levels, target_.levels),
                                                      PoseGuess(guess.inverse()), RegistrationOptions{});
    if (const auto apart = distanceIfFar(found.target_T_source, back.target_T_source.inverse())) return apart;
  }
  return found.overlap < kAll ? rivalAtAnotherHeading(found, guess) : std::nullopt;
}

std::optional<PoseError> CloudPair::rivalAtAnotherHeading(const RegistrationResult& found, const Rigid& guess) const
{
  constexpr double kMost = 0.9;                             // overlap, from which on a rival must be better
  const double as_good = found.overlap < kMost ? 0.95 : 1;  // of the score; scores are negative
  for (const double turn : {90, 180, 270})
  {
    const RegistrationResult rival =
        registered(guess * Rigid::fromXyzYawPitchRoll(0, 0, 0, turn * kDegree, 0, 0)).result;
    if (rival.outcome == Outcome::LowOverlap || rival.score > as_good * found.score) continue;
    if (const auto apart = distanceIfFar(found.target_T_source, rival.target_T_source)) return apart;
  }
  return std::nullopt;
}
}  // namespace scanloom
