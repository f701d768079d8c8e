#include "ndt/Registration.h"

#include "ndt/LidarInformation.h"
#include "ndt/Minimiser.h"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
struct Aligned
{
  Minimum minimum;
  LidarInformation lidar;
};

Aligned alignLevel(Neighbourhoods& neighbourhoods, const Rigid& guess, const RegistrationOptions& options)
{
  Minimum minimum = minimise(neighbourhoods, guess, options, {});
  LidarInformation lidar = lidarInformation(neighbourhoods, minimum.target_T_source, options.d2);
  if (lidar.degenerate.empty()) return {minimum, lidar};

  // What slid along a direction that nothing measures was noise: from the guess again, without it.
  const int iterations = minimum.iterations;
  minimum = minimise(neighbourhoods, guess, options, lidar.degenerate);
  minimum.iterations += iterations;
  return {minimum, lidar};
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

/** Of coarse levels and first steps: what follows is more exact. */
RegistrationOptions first(const RegistrationOptions& last)
{
  RegistrationOptions options = last;
  options.d2 = std::min(last.first_d2, last.d2);
  options.tolerance = 10 * last.tolerance;
  return options;
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
}  // namespace

RegistrationResult align(const NdtMap& target, const NdtMap& source, const Rigid& guess,
                         const RegistrationOptions& options)
{
  Neighbourhoods neighbourhoods(target, source, options.neighbours);
  const Minimum wide =
      options.first_d2 < options.d2 ? minimise(neighbourhoods, guess, first(options), {}) : Minimum{guess, {}, 0, false};
  RegistrationResult result =
      resultOf(alignLevel(neighbourhoods, wide.target_T_source, options), source, options);
  result.iterations += wide.iterations;
  return result;
}

RegistrationResult alignCoarseToFine(const std::vector<RegistrationLevel>& levels, const Rigid& guess,
                                     const RegistrationOptions& last)
{
  if (levels.empty()) throw std::invalid_argument("alignCoarseToFine: at least one level is needed");
  if (levels.size() == 1) return align(levels.front().target, levels.front().source, guess, last);
  RegistrationOptions coarse = first(last);
  coarse.neighbours = std::min(last.neighbours, 7);
  Rigid pose = guess;
  int iterations = 0;
  for (auto level = levels.begin(); level != levels.end() - 1; ++level)
  {
    Neighbourhoods neighbourhoods(level->target, level->source, coarse.neighbours);
    const Minimum minimum = alignLevel(neighbourhoods, pose, coarse).minimum;
    iterations += minimum.iterations;
    if (overlapOf(minimum, level->source) >= coarse.min_overlap) pose = minimum.target_T_source;
  }
  const NdtMap &target = levels.back().target, &source = levels.back().source;
  Neighbourhoods neighbourhoods(target, source, last.neighbours);
  RegistrationResult result = resultOf(alignLevel(neighbourhoods, pose, last), source, last);
  result.iterations += iterations;
  return result;
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
