#include "mrpt/sensors/internal/rigSettingsFrom.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
/**
 * `configuration:12: [lidars] unknown ...` becomes `section 'lidars': unknown ...`. The line number would be one of the
 * text that is made here. And MRPT takes text in brackets for the place of an exception and prints it after the
 * message.
 */
std::string forMrpt(const std::string& problem, const std::string& section)
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
    for (const std::string& problem : e.problems) problems.push_back(forMrpt(problem, section));
    throw ConfigError(problems);
  }
}
}  // namespace scanloom
