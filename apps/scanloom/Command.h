/** Programs that ours starts, one process each. */
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
  std::vector<std::string> environment;  // NAME=value, on top of ours
};

/** As one would type it. */
std::string toText(const Command&);

/** `--set NAME=VALUE` for each. */
void addSettings(std::vector<std::string>& words, const std::vector<std::pair<std::string, std::string>>& settings);

/** The file that this program was started from. */
std::filesystem::path ownExecutable();

/**
 * Waits for its end; both of its streams are appended to `log`. When the program is interrupted, so is the command.
 * @return its exit status, or 128 + the signal that ended it. Throws std::runtime_error if it cannot be started.
 */
int runCommand(const Command&, const std::filesystem::path& log);

/**
 * For a verb of ours, a quality gate that it does not pass is no failure.
 * Throws std::runtime_error with the last line of the log if it fails.
 */
void runVerb(const Command&, const std::filesystem::path& log);
}  // namespace scanloom
