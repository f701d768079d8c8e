#include "Arguments.h"

#include "base/core/OutputFile.h"

namespace scanloom
{
Option addConfiguration(CLI::App& app, ConfigurationArguments& arguments)
{
  addOption(app, "--set", arguments.assignments,
            "set a key, instead of its value in the files, e.g. map_cells.cell_size=0.5 (repeatable)")
      .typeName("SECTION.KEY=VALUE")
      .repeatable();
  return addOption(app, "-c,--config", arguments.files,
                   "configuration file (INI); several files are read together (repeatable)")
      .typeName("FILE")
      .repeatable();
}

void addDryRun(CLI::App& app, ConfigurationArguments& arguments)
{
  addFlag(app, "--dry-run", arguments.dry_run, "check everything, print the values in effect, and stop");
}

Option addOutputFolder(CLI::App& app, OutputFolderArguments& arguments)
{
  addOverwrite(app, arguments.overwrite);
  return addOption(app, "--out-dir", arguments.folder, "folder for the results; it is created if it does not exist")
      .typeName("DIR");
}

void refuseExisting(const OutputFolderArguments& arguments, const std::vector<std::string>& names)
{
  const auto& folder = arguments.folder;
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder))
    throw UsageError("--out-dir " + folder.string() + ": exists and is not a folder");

  std::vector<std::filesystem::path> files;
  for (const std::string& name : names) files.push_back(folder / name);
  refuseExisting(files, arguments.overwrite);
}

Option addSeconds(CLI::App& app, double& seconds)
{
  return addOption(app, "--seconds", seconds, "live lidars: stop after this time, in s; 0: run until Ctrl-C")
      .notNegative();
}

void refuseSeconds(double seconds)
{
  if (seconds > 0) throw UsageError("--seconds is for live lidars only: recordings end by themselves");
}

Option addOverwrite(CLI::App& app, bool& overwrite)
{
  return addFlag(app, "-w,--overwrite", overwrite, "replace output files that exist");
}

Option addJson(CLI::App& app, bool& json) { return addFlag(app, "--json", json, "print the results as JSON"); }
}  // namespace scanloom
