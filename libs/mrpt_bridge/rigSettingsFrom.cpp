#include "mrpt_bridge/rigSettingsFrom.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
/**
 * `configuration:12: [lidars] unknown ...` as `section 'lidars': unknown ...`: the place would be one in the text made
 * here, which nobody has, and what stands in brackets MRPT prints as the place of an exception, after its message.
 */
std::string asMrptPrintsItWell(const std::string& problem, const std::string& section)
{
  const std::string bracketed = fmt::format("[{}] ", section);
  const auto start = problem.find(bracketed);
  if (start == std::string::npos) return problem;
  return fmt::format("section '{}': {}", section, problem.substr(start + bracketed.size()));
}
}  // namespace

RigSettings rigSettingsFrom(const mrpt::config::CConfigFileBase& source, const std::string& section)
{
  std::vector<std::string> keys;
  source.getAllKeys(section, keys);
  std::string text = fmt::format("[{}]\n", section);
  for (const std::string& key : keys) text += fmt::format("{} = {}\n", key, source.read_string(section, key, ""));
  try
  {
    return readRigSettings(Configuration::fromText(text, "configuration"), section);
  }
  catch (const ConfigError& e)
  {
    std::vector<std::string> problems;
    for (const std::string& problem : e.problems) problems.push_back(asMrptPrintsItWell(problem, section));
    throw ConfigError(problems);
  }
}
}  // namespace scanloom
