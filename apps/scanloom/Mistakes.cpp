#include "Mistakes.h"

#include "base/core/ConfigError.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string_view>

namespace scanloom
{
bool Mistakes::inRunsWith(const std::string& key, const std::string& value, const std::function<void()>& check)
{
  return collect(check, fmt::format("{}: [experiment] {} = {}: ", file_, key, value));
}

bool Mistakes::inSettings(const std::function<void()>& check) { return collect(check, ""); }

void Mistakes::refuseAny() const
{
  if (!found_.empty()) throw ConfigError(found_);
}

bool Mistakes::collect(const std::function<void()>& check, const std::string& prefix)
try
{
  check();
  return true;
}
catch (const ConfigError& error)
{
  for (const std::string& problem : error.problems) add(prefix + inOurFile(problem));
  return false;
}
catch (const std::exception& error)
{
  add(prefix + error.what());
  return false;
}

/** A run gets by --set what stands in the file of the sweep. */
std::string Mistakes::inOurFile(const std::string& problem) const
{
  constexpr std::string_view kSet = "--set: ";
  return problem.rfind(kSet, 0) == 0 ? file_ + ": " + problem.substr(kSet.size()) : problem;
}

void Mistakes::add(const std::string& problem)
{
  if (std::find(found_.begin(), found_.end(), problem) == found_.end()) found_.push_back(problem);
}
}  // namespace scanloom
