#include "estimation/ndt/Registration.h"

#include "base/core/Decompositions.h"
#include "base/core/Statistics.h"
#include "estimation/ndt/FittedConstants.h"
#include "estimation/ndt/LidarInformation.h"
#include "estimation/ndt/Minimiser.h"
#include "estimation/ndt/internal/AmbiguousPoses.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
constexpr double kLoose = 30;  // factor on the tolerance where a more accurate search follows

struct Aligned
{
  Minimum minimum;
  LidarInformation lidar;
};

/** With the steps of the search before it. */
Minimum after(const Minimum& first, Minimum minimum)
{
  minimum.iterations += first.iterations;
  return minimum;
}

/** Searches on one level, which go on with the correspondences of those before. */
class LevelSearch
{
 public:
  using Directions = std::vector<Vector6d>;

  LevelSearch(const RegistrationLevel& level, const PosePrior& prior, int neighbours)
    : correspondences_(level.target, level.source, neighbours), prior_(prior)
  {
  }

  /** `widely`: with the wide score first, because the start may be far off; `locked` as in minimise(). */
  Minimum from(const Rigid& start, bool widely, const RegistrationOptions& options, const Directions& locked)
  {
    if (!widely || options.first_d2 >= options.d2) return closeTo(start, options, locked);
    RegistrationOptions wide = options;
    wide.d2 = options.first_d2;
    wide.tolerance = kLoose * options.tolerance;
    const Minimum first = closeTo(start, wide, locked);
    return after(first, closeTo(first.target_T_source, options, locked));
  }

  /**
   * Where the start is near, which first_d2 = d2 says: among the cells that both maps have there, and once more from
   * the end of that search if it is far from the start. Elsewhere, and of source cells that are larger than the
   * target's, which have several for their own: among all cells.
   */
  Minimum amongCommon(const Rigid& start, bool widely, const RegistrationOptions& options, const Directions& locked)
  {
    const bool is_large = correspondences_.sourceEdge() > correspondences_.targetMap().options().cell_size;
    if (is_large || options.first_d2 < options.d2) return from(start, widely, options, locked);
    correspondences_.keepCommon(start);
    const Minimum first = closeTo(start, options, locked);
    const double moved = boxMinus(first.target_T_source, start).cwiseQuotient(stepOfMetres()).norm();
    // From farther away means have moved to other cubes: the cells that both maps have are chosen anew.
    if (moved < fitted::kStillNear * correspondences_.sourceEdge()) return first;
    correspondences_.keepCommon(first.target_T_source);
    return after(first, closeTo(first.target_T_source, options, locked));
  }

  Minimum closeTo(const Rigid& start, const RegistrationOptions& options, const Directions& locked)
  {
    return minimise(correspondences_, start, prior_, options, locked);
  }

  /** Moved to where the last search ended. */
  const CellCorrespondences& correspondences() const { return correspondences_; }

 private:
  CellCorrespondences correspondences_;
  const PosePrior& prior_;
};

/**
 * The step into the minimum by the score's second derivative, which the search has not; none where the objective is not
 * convex, or where it leads farther than a search that ended with `tolerance` (m) can be off.
 */
std::optional<Vector6d> lastStep(const Rigid& pose, const LidarInformation& lidar, const PosePrior& prior, double d2,
                                 double tolerance)
{
  NormalEquations equations{0, lidar.gradient, lidar.curvature, 0};
  equations = prior.addedTo(equations, pose, d2);
  const std::optional<Vector6d> back = solvePositive(equations.curvature, equations.gradient);
  if (!back || back->cwiseQuotient(stepOfMetres()).norm() > 10 * tolerance) return std::nullopt;
  return -*back;
}

/** The search ends early, because the covariance has what a better last step takes. */
Aligned alignLevel(const RegistrationLevel& level, const Rigid& start, bool widely, const PosePrior& prior,
                   const RegistrationOptions& options)
{
  RegistrationOptions early = options;
  early.tolerance = 10 * options.tolerance;
  LevelSearch search(level, prior, options.neighbours);
  Minimum minimum = search.amongCommon(start, widely, early, {});
  LidarInformation lidar = lidarInformation(search.correspondences(), minimum.target_T_source, options.d2);
  // Where two minima meet, the scan measures nothing, and the prior knows better.
  if (prior.isGiven() && lidar.degenerate.empty()) lidar.degenerate = unmeasuredDirections(lidar.covariance);
  if (!lidar.degenerate.empty())  // motion along such a direction was noise: again without it
    return {after(minimum, search.amongCommon(start, widely, options, lidar.degenerate)), lidar};
  Rigid& pose = minimum.target_T_source;
  if (const std::optional<Vector6d> step = lastStep(pose, lidar, prior, options.d2, early.tolerance))
    pose = boxPlus(pose, *step);
  else
    minimum = after(minimum, search.closeTo(pose, options, {}));
  return {minimum, lidar};
}

/** The start of the next level. */
struct Approached
{
  Minimum minimum;
  bool may_slide;  // this level left a direction open
};

/** `may_slide`: so did a coarser level. */
Approached approach(const RegistrationLevel& level, const Rigid& start, bool widely, const PosePrior& prior,
                    const RegistrationOptions& options, bool may_slide)
{
  LevelSearch search(level, prior, options.neighbours);
  const Minimum minimum = search.from(start, widely, options, {});
  if (!may_slide) return {minimum, false};
  const auto degenerate = degenerateDirections(search.correspondences(), minimum.target_T_source, options.d2);
  if (degenerate.empty()) return {minimum, false};
  return {after(minimum, search.from(start, widely, options, degenerate)), true};
}

double overlapOf(const Minimum& minimum, const NdtMap& source)
{
  double points = 0;
  for (const GaussianCell& cell : source.cells()) points += cell.points;
  return minimum.equations.met_points / std::max(1.0, points);
}

Outcome outcomeOf(const Minimum& minimum, double overlap, bool degenerate, const RegistrationOptions& options)
{
  if (minimum.equations.met_points == 0 || overlap < options.min_overlap) return Outcome::LowOverlap;
  if (degenerate) return Outcome::Degenerate;
  return minimum.converged ? Outcome::Converged : Outcome::IterationLimit;
}

RegistrationResult resultOf(const Aligned& aligned, const NdtMap& source, const RegistrationOptions& options)
{
  const auto& [minimum, lidar] = aligned;
  RegistrationResult result;
  result.target_T_source = minimum.target_T_source;
  result.iterations = minimum.iterations;
  result.degenerate_directions = lidar.degenerate;
  result.overlap = overlapOf(minimum, source);
  result.score = minimum.equations.value / std::max(1.0, static_cast<double>(source.cells().size()));
  result.outcome = outcomeOf(minimum, result.overlap, !lidar.degenerate.empty(), options);
  if (minimum.equations.met_points == 0) return result;
  result.covariance = lidar.covariance;
  result.viewpoint_bias = lidar.viewpoint_bias;
  result.information = inverse(lidar.covariance);
  return result;
}

/** Takes the pose that is nearest to the guess, and adds the distances to the others to the covariance. */
RegistrationResult weighedAgainstRivals(RegistrationResult result, const RegistrationLevel& level,
                                        const PoseGuess& guess, const RegistrationOptions& options)
{
  if (result.outcome == Outcome::LowOverlap) return result;
  result.rivals = ambiguousPoses(level, result, guess, options);
  if (result.rivals.empty()) return result;
  for (Rigid& rival : result.rivals)
    if (mahalanobisDistance(guess, rival) < mahalanobisDistance(guess, result.target_T_source))
      std::swap(rival, result.target_T_source);
  result.outcome = Outcome::Degenerate;
  for (const Rigid& rival : result.rivals)
  {
    const Vector6d apart = boxMinus(rival, result.target_T_source);
    result.covariance += apart * apart.transpose();
    Vector6d direction = stepOfMetres().cwiseInverse().cwiseProduct(apart).normalized();
    for (const Vector6d& before : result.degenerate_directions) direction -= before.dot(direction) * before;
    // Else it is along those that are known.
    if (direction.norm() > 0.3) result.degenerate_directions.push_back(direction.normalized());
  }
  result.information = inverse(result.covariance);
  return result;
}

/** The finest level with cells that are large enough for the deviations of the guess. */
std::size_t firstLevel(const std::vector<RegistrationLevel>& levels, const PoseGuess& guess)
{
  if (!guess.covariance) return 0;
  const double reach = 3 * largestDeviation(*guess.covariance);
  std::size_t level = levels.size() - 1;
  while (level > 0 && reach > fitted::kReachOfCells * levels[level].source.options().cell_size) --level;
  return level;
}

/** The level whose score depends on the heading most clearly: stems differ from their cells, and few leave them. */
std::size_t levelForTurns(const std::vector<RegistrationLevel>& levels, std::size_t first)
{
  std::size_t level = first;
  while (level < levels.size() && levels[level].source.options().cell_size > 4) ++level;
  return level;
}

/**
 * The pose with the best of several headings. Alignment finds the tilt from anywhere by the ground, but not the
 * heading: stems that are turned out of the cells around theirs do not contribute.
 */
Rigid bestTurnOf(const RegistrationLevel& level, const Rigid& pose, const PoseGuess& guess)
{
  constexpr double kStep = 5 * M_PI / 180, kMost = 5;
  const double reach = guess.covariance ? 3 * std::sqrt((*guess.covariance)(5, 5)) / kStep : kMost;
  const int most = static_cast<int>(std::min(reach, kMost));
  CellCorrespondences correspondences(level.target, level.source, 7);
  Rigid best = pose;
  std::vector<double> scores;
  double highest = 0;
  for (int turn = -most; turn <= most; ++turn)
  {
    const Rigid there = pose * Rigid::fromXyzYawPitchRoll(0, 0, 0, turn * kStep, 0, 0);
    scores.push_back(-normalEquations(correspondences, there, fitted::kBroadD2).value);
    if (scores.back() > highest) highest = scores.back(), best = there;
  }
  return highest > fitted::kHeadingStandsOut * upperMedian(std::move(scores)) ? best : pose;
}
}  // namespace

RegistrationResult align(const NdtMap& target, const NdtMap& source, const PoseGuess& guess,
                         const RegistrationOptions& options)
{
  return alignCoarseToFine({{target, source}}, guess, options);
}

std::vector<RegistrationLevel> pairLevels(const std::vector<NdtMap>& targets, const std::vector<NdtMap>& sources)
{
  if (targets.size() != sources.size())
    throw std::invalid_argument("pairLevels: as many sources as targets are needed");
  std::vector<RegistrationLevel> levels;
  for (std::size_t i = 0; i < targets.size(); ++i) levels.push_back({targets[i], sources[i]});
  return levels;
}

RegistrationResult alignCoarseToFine(const std::vector<RegistrationLevel>& levels, const PoseGuess& guess,
                                     const RegistrationOptions& options)
{
  if (levels.empty()) throw std::invalid_argument("alignCoarseToFine: at least one level is needed");
  const PosePrior prior(guess);
  RegistrationOptions coarse = options;
  coarse.tolerance = kLoose * options.tolerance;
  Rigid pose = guess.target_T_source;
  int iterations = 0;
  bool may_slide = true;  // finer cells may determine what coarse ones leave open, not the reverse
  const std::size_t first = firstLevel(levels, guess), last = levels.size() - 1;
  const std::size_t turns = levelForTurns(levels, first);
  for (std::size_t i = first; i < last; ++i)
  {
    if (i == turns) pose = bestTurnOf(levels[i], pose, guess);
    const auto [minimum, slides] = approach(levels[i], pose, i == first, prior, coarse, may_slide);
    may_slide = slides;
    iterations += minimum.iterations;
    if (overlapOf(minimum, levels[i].source) >= options.min_overlap) pose = minimum.target_T_source;
  }
  const Aligned aligned = alignLevel(levels[last], pose, first == last, prior, options);
  RegistrationResult result = resultOf(aligned, levels[last].source, options);
  result.iterations += iterations;
  return weighedAgainstRivals(std::move(result), levels[last], guess, options);
}

PoseGuess::PoseGuess(const Rigid& pose, const Matrix6d& its_covariance)
  : target_T_source(pose), covariance(its_covariance)
{
  if (isPositiveDefinite(its_covariance)) return;
  throw std::invalid_argument("PoseGuess: the covariance is not positive definite");
}

std::string toString(Outcome outcome)
{
  switch (outcome)
  {
    case Outcome::Converged:
      return "converged";
    case Outcome::IterationLimit:
      return "iteration limit";
    case Outcome::LowOverlap:
      return "low overlap";
    case Outcome::Degenerate:
      return "degenerate";
  }
  return "unknown";
}
}  // namespace scanloom
