/** Starts another program as a process of its own. */
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace scanloom
{
struct Command
{
  std::vector<std::string> words;        // the program first
  std::vector<std::string> environment;  // NAME=value, in addition to that of this program
};

/** The line that a person would type, with quotes where they are needed. */
std::string toText(const Command&);

/** `--set NAME=VALUE` for each. */
void addSettings(std::vector<std::string>& words, const std::vector<std::pair<std::string, std::string>>& settings);

/** The file of the program that runs. */
std::filesystem::path ownExecutable();

/**
 * Runs it to its end. Its stdout and stderr are appended to `log`. If this program is interrupted, the other one gets
 * SIGTERM.
 * @return its exit status, or 128 + the signal that ended it. Throws std::runtime_error if it cannot be started.
 */
int runCommand(const Command&, const std::filesystem::path& log);

/**
 * Runs a verb of scanloom. Throws std::runtime_error with the last line of the log if its status is neither 0 nor 3
 * (all outputs written, but a quality gate failed).
 */
void runVerb(const Command&, const std::filesystem::path& log);
}  // namespace scanloom
