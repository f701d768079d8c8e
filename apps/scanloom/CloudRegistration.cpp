#include "CloudRegistration.h"

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
}  // namespace

std::vector<double> levelsOf(const RegisterSettings& settings, const Configuration& configuration)
{
  const Bounds bounds = boundsOfCellSize();
  std::vector<double> levels;
  std::istringstream words(settings.clouds.levels);
  for (std::string word; words >> word;)
  {
    const auto size = parseNumber(word);
    const bool finer = size && (levels.empty() || *size < levels.back());
    if (!finer || *size < bounds.lowest || *size > bounds.highest)
    {
      levels.clear();
      break;
    }
    levels.push_back(*size);
  }
  if (levels.empty())
    throw configuration.complaint(
        "register", "levels", "must be lengths " + toString(bounds) + " m, separated by blanks, each below the last");
  return levels;
}

CloudPair::CloudPair(const Points& target, const Points& source, const std::vector<double>& levels,
                     const RegisterSettings& settings)
  : target_(prepare(target, levels, settings.clouds.cells)),
    source_(prepare(source, levels, settings.clouds.cells)),
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

TimedRegistration CloudPair::registered(const Rigid& guess) const
{
  const Stopwatch stopwatch;
  std::vector<RegistrationLevel> levels;
  for (std::size_t i = 0; i < target_.levels.size(); ++i) levels.push_back({target_.levels[i], source_.levels[i]});
  const RegistrationResult result = alignCoarseToFine(levels, guess, options_);
  return {result, stopwatch.milliseconds()};
}
}  // namespace scanloom
