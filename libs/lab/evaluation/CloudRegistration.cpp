#include "lab/evaluation/CloudRegistration.h"

#include "base/core/Angle.h"

#include <chrono>
#include <sstream>

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

Bounds boundsOfCellSize()
{
  Bounds bounds;
  NdtOptions options;
  NdtOptions::fields(options,
                     [&](auto&, const Field& field)
                     {
                       if (field.name == "cell_size") bounds = field.bounds;
                     });
  return bounds;
}

std::vector<double> sizesOf(const std::string& text, const std::string& key, const Configuration& configuration)
{
  const Bounds bounds = boundsOfCellSize();
  std::vector<double> sizes;
  std::istringstream words(text);
  for (std::string word; words >> word;)
  {
    const auto size = parseNumber(word);
    const bool finer = size && (sizes.empty() || *size < sizes.back());
    if (!finer || *size < bounds.lowest || *size > bounds.highest)
    {
      sizes.clear();
      break;
    }
    sizes.push_back(*size);
  }
  if (sizes.empty())
    throw configuration.complaint(
        "register", key,
        "must be lengths " + toString(bounds) + " m, separated by blanks, each smaller than the one before");
  return sizes;
}
/** Within half a metre and 5 deg two results are one. */
std::optional<PoseError> distanceIfFar(const Rigid& pose, const Rigid& other)
{
  constexpr double kMetres = 0.5, kDegrees = 5;
  const PoseError apart = poseError(pose, other);
  return apart.metres > kMetres || apart.degrees > kDegrees ? std::optional(apart) : std::nullopt;
}
}  // namespace

LevelSizes levelsOf(const RegisterSettings& settings, const Configuration& configuration)
{
  LevelSizes sizes{sizesOf(settings.clouds.levels, "levels", configuration),
                   sizesOf(settings.clouds.source_levels, "source_levels", configuration)};
  if (sizes.target.size() != sizes.source.size())
    throw configuration.complaint("register", "source_levels", "must have as many lengths as levels");
  return sizes;
}

CloudPair::CloudPair(const Points& target, const Points& source, const LevelSizes& levels,
                     const RegisterSettings& settings)
  : target_(prepare(target, levels.target, settings.clouds.cells)),
    source_(prepare(source, levels.source, settings.clouds.cells)),
    options_(settings.alignment)
{
}

CloudPair::Prepared CloudPair::prepare(const Points& points, const std::vector<double>& levels,
                                       const NdtOptions& options)
{
  const Stopwatch stopwatch;
  std::vector<NdtMap> maps = ndtLevels(points, levels, options);
  return {std::move(maps), stopwatch.milliseconds()};
}

TimedRegistration CloudPair::registered(const PoseGuess& guess) const
{
  const Stopwatch stopwatch;
  const RegistrationResult result = alignCoarseToFine(pairLevels(target_.levels, source_.levels), guess, options_);
  return {result, stopwatch.milliseconds()};
}

std::optional<PoseError> CloudPair::contradiction(const RegistrationResult& found, const Rigid& guess) const
{
  constexpr double kFew = 0.5, kAll = 0.99;  // overlaps
  if (found.overlap < kFew)
  {
    const RegistrationResult back =
        alignCoarseToFine(pairLevels(source_.levels, target_.levels), PoseGuess(guess.inverse()), options_);
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
