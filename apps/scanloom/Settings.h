/** Reads and checks the whole configuration of a verb. */
#pragma once
#include "Arguments.h"
#include "Verb.h"

namespace scanloom
{
template <typename Settings>
struct Loaded
{
  Configuration configuration;
  Settings settings;
};

/** @throws ConfigError with all problems: wrong values, and names that no verb knows. */
template <typename Settings>
Loaded<Settings> load(const ConfigurationArguments& arguments)
{
  Configuration configuration = Configuration::fromFiles(arguments.files);
  for (const std::string& assignment : arguments.assignments) configuration.set(assignment);
  Settings settings = readSettings<Settings>(configuration, knownToAnyVerb());
  return {std::move(configuration), std::move(settings)};
}

/** The INI file that repeats the run: --dry-run prints it, and it is written beside the results. */
template <typename Settings>
std::string toIni(const Loaded<Settings>& loaded)
{
  return toIni(schemaOf(loaded.settings), loaded.configuration);
}
}  // namespace scanloom
