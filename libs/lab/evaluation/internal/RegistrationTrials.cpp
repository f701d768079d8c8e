#include "lab/evaluation/internal/RegistrationTrials.h"

#include "base/core/Angle.h"
#include "base/core/Statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr PoseError kSuccess{0.1, 1};

using Generator = std::mt19937_64;

/** In [0, 1), from the generator's bits: the standard's distributions differ between libraries. */
double uniform(Generator& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

Eigen::Vector3d direction(Generator& random)
{
  const double z = 2 * uniform(random) - 1, azimuth = 2 * M_PI * uniform(random);
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

Eigen::Vector3d axis(SpreadAxis kind, Generator& random)
{
  if (kind == SpreadAxis::Any) return direction(random);
  return {0, 0, uniform(random) < 0.5 ? -1.0 : 1.0};
}

Rigid offset(const TrialOptions& options, Generator& random)
{
  Vector6d step;
  step.head<3>() = options.spread * direction(random);
  step.tail<3>() = options.spread_deg * kDegree * axis(options.axis, random);
  return boxPlus(Rigid::identity(), step);
}

double meanOf(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Spread spreadOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return {quantileOfSorted(values, 0.5), quantileOfSorted(values, 0.95), values.back(), meanOf(values)};
}

double nees(const RegistrationResult& result, const Rigid& truth)
{
  const Vector6d e = boxMinus(truth, result.target_T_source);
  return e.dot(result.information * e);
}
}  // namespace

PoseError poseError(const Rigid& estimate, const Rigid& truth)
{
  const Vector6d e = boxMinus(estimate, truth);
  return {e.head<3>().norm(), e.tail<3>().norm() / kDegree};
}

std::vector<Rigid> guessesAround(const Rigid& truth, const TrialOptions& options)
{
  Generator random(options.seed);
  std::vector<Rigid> guesses;
  for (std::size_t i = 0; i < options.trials; ++i) guesses.push_back(truth * offset(options, random));
  return guesses;
}

TrialsReport tryRegistration(const Rigid& truth, const TrialOptions& options,
                             const std::function<TimedRegistration(const Rigid& guess)>& registered)
{
  if (options.trials == 0) throw std::invalid_argument("tryRegistration: no trials");
  TrialsReport report;
  report.trials = options.trials;
  std::vector<double> metres, degrees, milliseconds;
  std::vector<double> nees_of_successes;
  for (const Rigid& guess : guessesAround(truth, options))
  {
    const auto [result, took] = registered(guess);
    const PoseError error = poseError(result.target_T_source, truth);
    metres.push_back(error.metres);
    degrees.push_back(error.degrees);
    milliseconds.push_back(took);
    ++report.outcomes[result.outcome];
    if (error.metres <= kSuccess.metres && error.degrees <= kSuccess.degrees)
      nees_of_successes.push_back(nees(result, truth));
  }
  report.success_rate = static_cast<double>(nees_of_successes.size()) / static_cast<double>(options.trials);
  if (!nees_of_successes.empty()) report.mean_nees = meanOf(nees_of_successes);
  report.metres = spreadOf(std::move(metres));
  report.degrees = spreadOf(std::move(degrees));
  report.milliseconds = spreadOf(std::move(milliseconds));
  return report;
}
}  // namespace scanloom
