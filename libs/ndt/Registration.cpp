#include "ndt/Registration.h"

#include "ndt/LidarInformation.h"
#include "ndt/Minimiser.h"
#include "ndt/Rivals.h"

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr double kLoose = 30;  // times the tolerance, where more exact steps follow

// Times a level's cells: from further away the level before it is needed.
constexpr double kReachOfCells = 0.3;

struct Aligned
{
  Minimum minimum;
  LidarInformation lidar;
};

/** By the wide score first, if the guess may be far off; `locked`: see minimise. */
Minimum search(Neighbourhoods& neighbourhoods, const Rigid& start, bool widely, const Expectation& expectation,
               const RegistrationOptions& options, const std::vector<Vector6d>& locked)
{
  if (!widely || options.first_d2 >= options.d2) return minimise(neighbourhoods, start, expectation, options, locked);
  RegistrationOptions wide = options;
  wide.d2 = options.first_d2;
  wide.tolerance = kLoose * options.tolerance;
  const Minimum first = minimise(neighbourhoods, start, expectation, wide, locked);
  Minimum minimum = minimise(neighbourhoods, first.target_T_source, expectation, options, locked);
  minimum.iterations += first.iterations;
  return minimum;
}

/** What slid along a direction that nothing measures was noise: from the start again, without it. */
Minimum searchAgain(Neighbourhoods& neighbourhoods, const Rigid& start, bool widely, const Expectation& expectation,
                    const RegistrationOptions& options, const std::vector<Vector6d>& degenerate, const Minimum& first)
{
  Minimum minimum = search(neighbourhoods, start, widely, expectation, options, degenerate);
  minimum.iterations += first.iterations;
  return minimum;
}

Aligned alignLevel(const RegistrationLevel& level, const Rigid& start, bool widely, const Expectation& expectation,
                   const RegistrationOptions& options)
{
  Neighbourhoods neighbourhoods(level.target, level.source, options.neighbours);
  Minimum minimum = search(neighbourhoods, start, widely, expectation, options, {});
  LidarInformation lidar = lidarInformation(neighbourhoods, minimum.target_T_source, options.d2);
  if (lidar.degenerate.empty()) return {minimum, lidar};
  return {searchAgain(neighbourhoods, start, widely, expectation, options, lidar.degenerate, minimum), lidar};
}

/** For the next level to start from. `may_slide`: where a coarser level left a direction open. */
Minimum approach(const RegistrationLevel& level, const Rigid& start, bool widely, const Expectation& expectation,
                 const RegistrationOptions& options, bool& may_slide)
{
  Neighbourhoods neighbourhoods(level.target, level.source, options.neighbours);
  const Minimum minimum = search(neighbourhoods, start, widely, expectation, options, {});
  if (!may_slide) return minimum;
  const auto degenerate = degenerateDirections(neighbourhoods, minimum.target_T_source, options.d2);
  may_slide = !degenerate.empty();
  if (!may_slide) return minimum;
  return searchAgain(neighbourhoods, start, widely, expectation, options, degenerate, minimum);
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
  result.information = lidar.covariance.inverse();
  return result;
}

/** Moves to the pose that surprises the guess least, and says what speaks for the others. */
void weighRivals(const RegistrationLevel& level, const PoseGuess& guess, const RegistrationOptions& options,
                 RegistrationResult& result)
{
  if (result.outcome == Outcome::LowOverlap) return;
  result.rivals = rivalsOf(level, result, guess, options);
  if (result.rivals.empty()) return;
  for (Rigid& rival : result.rivals)
    if (surprise(guess, rival) < surprise(guess, result.target_T_source)) std::swap(rival, result.target_T_source);
  result.outcome = Outcome::Degenerate;
  for (const Rigid& rival : result.rivals)
  {
    const Vector6d way = boxMinus(rival, result.target_T_source);
    result.covariance += way * way.transpose();
    Vector6d direction = stepOfMetres().cwiseInverse().cwiseProduct(way).normalized();
    for (const Vector6d& before : result.degenerate_directions) direction -= before.dot(direction) * before;
    constexpr double kNew = 0.3;
    if (direction.norm() > kNew) result.degenerate_directions.push_back(direction.normalized());
  }
  result.information = result.covariance.inverse();
}

/** The finest level of those whose cells are not smaller than what the guess may be off by asks for. */
std::size_t firstLevel(const std::vector<RegistrationLevel>& levels, const PoseGuess& guess)
{
  if (!guess.covariance) return 0;
  const double reach = 3 * largestDeviation(*guess.covariance);
  std::size_t level = levels.size() - 1;
  while (level > 0 && reach > kReachOfCells * levels[level].source.options().cell_size) --level;
  return level;
}

/** The level whose score tells a turn best: stems still stand out of their cells, and a turn moves few of them away. */
std::size_t levelForTurns(const std::vector<RegistrationLevel>& levels, std::size_t first)
{
  constexpr double kCells = 4;  // m
  std::size_t level = first;
  while (level < levels.size() && levels[level].source.options().cell_size > kCells) ++level;
  return level;
}

/**
 * The best of turns about the source's z axis. Ground holds the tilt from anywhere, but it has no heading, and stems
 * that are turned further than their neighbourhood draw nowhere.
 */
Rigid turned(const RegistrationLevel& level, const Rigid& pose, const PoseGuess& guess)
{
  constexpr double kStep = 5 * M_PI / 180, kMost = 5;
  constexpr double kBroad = 0.05;      // d2
  constexpr double kStandsOut = 1.04;  // times the median score: bare ground's best has 1.03, a dense stand's 1.06
  constexpr int kNeighbours = 7;
  const double reach = guess.covariance ? 3 * std::sqrt((*guess.covariance)(5, 5)) / kStep : kMost;
  const int most = static_cast<int>(std::min(reach, kMost));
  Neighbourhoods neighbourhoods(level.target, level.source, kNeighbours);
  Rigid best = pose;
  std::vector<double> scores;
  double highest = 0;
  for (int turn = -most; turn <= most; ++turn)
  {
    const Rigid there = pose * Rigid::fromXyzYawPitchRoll(0, 0, 0, turn * kStep, 0, 0);
    scores.push_back(-normalEquations(neighbourhoods, there, kBroad).value);
    if (scores.back() > highest) highest = scores.back(), best = there;
  }
  std::nth_element(scores.begin(), scores.begin() + most, scores.end());
  return highest > kStandsOut * scores[static_cast<std::size_t>(most)] ? best : pose;
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
  const Expectation expectation(guess);
  RegistrationOptions coarse = options;
  coarse.tolerance = kLoose * options.tolerance;
  Rigid pose = guess.target_T_source;
  int iterations = 0;
  bool may_slide = true;  // what is open in coarse cells may be held by finer ones, not the other way round
  const std::size_t first = firstLevel(levels, guess), last = levels.size() - 1;
  const std::size_t turns = levelForTurns(levels, first);
  for (std::size_t i = first; i < last; ++i)
  {
    if (i == turns) pose = turned(levels[i], pose, guess);
    const Minimum minimum = approach(levels[i], pose, i == first, expectation, coarse, may_slide);
    iterations += minimum.iterations;
    if (overlapOf(minimum, levels[i].source) >= options.min_overlap) pose = minimum.target_T_source;
  }
  const Aligned aligned = alignLevel(levels[last], pose, first == last, expectation, options);
  RegistrationResult result = resultOf(aligned, levels[last].source, options);
  result.iterations += iterations;
  weighRivals(levels[last], guess, options, result);
  return result;
}

PoseGuess::PoseGuess(const Rigid& pose, const Matrix6d& its_covariance)
  : target_T_source(pose), covariance(its_covariance)
{
  if (its_covariance.allFinite() && its_covariance.llt().info() == Eigen::Success) return;
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

std::string RegistrationResult::brief() const
{
  const Eigen::Vector3d& t = target_T_source.translation;
  const Eigen::Vector3d degrees = target_T_source.yawPitchRoll() * 180 / M_PI;
  const auto deviation = [this](int first) { return std::sqrt(covariance.block<3, 3>(first, first).trace()); };
  return fmt::format(
      "{}{}: ({:.3f} {:.3f} {:.3f}) m, yaw pitch roll ({:.3f} {:.3f} {:.3f}) deg, +- {:.3f} m {:.3f} deg, "
      "overlap {:.0f} %, score {:.2f}, {} iterations",
      toString(outcome),
      degenerate_directions.empty() ? std::string() : fmt::format(" in {} directions", degenerate_directions.size()),
      t.x(), t.y(), t.z(), degrees[0], degrees[1], degrees[2], deviation(0), deviation(3) * 180 / M_PI, 100 * overlap,
      score, iterations);
}
}  // namespace scanloom
