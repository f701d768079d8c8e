/** How often, how well and how fast a registration finds a known pose from guesses that are off by a known amount. */
#pragma once
#include "ndt/Registration.h"

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

/** Norms of the step from the truth to the estimate. */
PoseError poseError(const Rigid& estimate, const Rigid& truth);

enum class SpreadAxis
{
  Any,       // uniform on the sphere
  Vertical,  // z, either way: the heading that a GNSS or a map gives
};

struct TrialOptions
{
  std::size_t trials = 50;
  double spread = 0;      // m, exactly, in a uniform direction
  double spread_deg = 0;  // exactly
  SpreadAxis axis = SpreadAxis::Any;
  std::uint64_t seed = 1;
};

/** truth * offset for each trial; the same seed gives the same guesses on every machine. */
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
  double success_rate = 0;  // share that ends within 0.1 m and 1 deg of the truth
  Spread metres, degrees, milliseconds;
  std::map<Outcome, std::size_t> outcomes;  // how many trials ended so
  /** Mean of e' information e over the successes, e = boxMinus(truth, estimate); 6 where the covariance is right. */
  std::optional<double> mean_nees;
};

/** Throws std::invalid_argument for no trials. */
TrialsReport tryRegistration(const Rigid& truth, const TrialOptions&,
                             const std::function<TimedRegistration(const Rigid& guess)>&);
}  // namespace scanloom
