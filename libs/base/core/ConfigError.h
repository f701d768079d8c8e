/** Errors in the command line or in a configuration file: the program ends with status 2. */
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace scanloom
{
/** The message tells what was given, what is wrong and how to mend it. */
struct UsageError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** All errors that were found, a line each: `harvester.ini:12: [ndt] cell_size = -1 m: must be > 0 (...)`. */
struct ConfigError : UsageError
{
  explicit ConfigError(std::vector<std::string> all_problems);
  explicit ConfigError(const std::string& problem) : ConfigError(std::vector<std::string>{problem}) {}

  std::vector<std::string> problems;
};
}  // namespace scanloom
