/** The options that several verbs share. */
#pragma once
#include "Options.h"
#include "base/config/Configuration.h"

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
/** Adds -c/--config, --set. @return the option -c, for a verb that requires it. */
Option addConfiguration(CLI::App&, ConfigurationArguments&);
void addDryRun(CLI::App&, ConfigurationArguments&);  // --dry-run

struct OutputFolderArguments
{
  std::filesystem::path folder;
  bool overwrite = false;
};
/** Adds --out-dir, -w/--overwrite. @return the option --out-dir. */
Option addOutputFolder(CLI::App&, OutputFolderArguments&);

/**
 * @param names of all files that will be written to the folder; it may hold other files.
 * @throws UsageError with the files that exist, unless -w was given.
 */
void refuseExisting(const OutputFolderArguments&, const std::vector<std::string>& names);

/** Adds --seconds, for live lidars. */
Option addSeconds(CLI::App&, double&);
/** For an input that ends by itself. @throws UsageError if `seconds` is given. */
void refuseSeconds(double seconds);

Option addOverwrite(CLI::App&, bool&);  // -w/--overwrite
Option addJson(CLI::App&, bool&);       // --json
}  // namespace scanloom
