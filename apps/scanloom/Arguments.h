/** Options that several verbs share, each with one name, one meaning and one help text. */
#pragma once
#include "config/Configuration.h"

#include <mrpt/system/COutputLogger.h>
#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
struct ConfigurationArguments
{
  std::vector<std::filesystem::path> files;
  std::vector<std::string> assignments;
  bool dry_run = false;
};
/** -c/--config, --set, --dry-run. @return the option -c, for a verb that requires it. */
CLI::Option* addConfiguration(CLI::App&, ConfigurationArguments&);

struct OutputFolderArguments
{
  std::filesystem::path folder;
  bool overwrite = false;
};
/** --out-dir, -w/--overwrite. @return the option --out-dir. */
CLI::Option* addOutputFolder(CLI::App&, OutputFolderArguments&);

/**
 * The folder may exist and hold other files.
 * @param names of all files that will be written there. @throws UsageError naming those that exist, without -w.
 */
void refuseExisting(const OutputFolderArguments&, const std::vector<std::string>& names);

/** A scene in place of a recording. */
struct SceneArguments
{
  std::filesystem::path file;  // empty: none
  std::uint64_t seed = 1;

  bool given() const { return !file.empty(); }
};
/** With the scene's file, if there is one, as the last one. */
ConfigurationArguments withScene(ConfigurationArguments, const SceneArguments&);
/** --simulate, --seed. @return the option --simulate. */
CLI::Option* addScene(CLI::App&, SceneArguments&);

/** --seconds, for live lidars: 0 until it is interrupted. @return the option. */
CLI::Option* addSeconds(CLI::App&, double&);
/** For an input that ends by itself. @throws UsageError if seconds were given. */
void refuseSeconds(double seconds);

CLI::Option* addOverwrite(CLI::App&, bool&);      // -w/--overwrite
CLI::Option* addJson(CLI::App&, bool&);           // --json: results as JSON on stdout
CLI::Option* addSeed(CLI::App&, std::uint64_t&);  // --seed
CLI::Option* addJobs(CLI::App&, int&);            // --jobs; 0: as many as there are cores
/** -v/--verbosity LEVEL (debug, info, warn, error), -q/--quiet. */
CLI::Option* addVerbosity(CLI::App&, mrpt::system::VerbosityLevel&);
}  // namespace scanloom
