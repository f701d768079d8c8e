/** Success rate, errors and time of a registration from many guesses at a known distance from the true pose. */
#pragma once
#include "estimation/ndt/Registration.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace scanloom
{
struct PoseError
{
  double metres = 0, degrees = 0;
};

/** Norms of the translation and of the rotation from the truth to the estimate. */
PoseError poseError(const Rigid& estimate, const Rigid& truth);

enum class SpreadAxis
{
  Any,       // uniformly distributed on the sphere
  Vertical,  // z, with a random sign: an error of the heading only
};

struct TrialOptions
{
  std::size_t trials = 50;
  double spread = 0;      // m: every guess is off by exactly this, in a random direction
  double spread_deg = 0;  // every guess is turned by exactly this
  SpreadAxis axis = SpreadAxis::Any;
  std::uint64_t seed = 1;
};

/** truth * offset for each trial. The same seed gives the same guesses on every machine. */
std::vector<Rigid> guessesAround(const Rigid& truth, const TrialOptions&);

struct TimedRegistration
{
  RegistrationResult result;
  double milliseconds = 0;
};

struct Spread
{
  double median = 0, percentile_95 = 0, largest = 0, mean = 0;
};

struct TrialsReport
{
  std::size_t trials = 0;
  double success_rate = 0;  // share of the trials that end within 0.1 m and 1 deg of the truth
  Spread metres, degrees, milliseconds;
  std::map<Outcome, std::size_t> outcomes;  // number of trials per outcome
  /** Mean of e' information e over the successes, e = boxMinus(truth, estimate). 6 if the covariance is right. */
  std::optional<double> mean_nees;
};

/** Throws std::invalid_argument for zero trials. */
TrialsReport tryRegistration(const Rigid& truth, const TrialOptions&,
                             const std::function<TimedRegistration(const Rigid& guess)>&);
}  // namespace scanloom
