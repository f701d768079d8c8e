#include "Arguments.h"

#include "config/AtomicFile.h"

#include <map>

namespace scanloom
{
CLI::Option* addConfiguration(CLI::App& app, ConfigurationArguments& arguments)
{
  app.add_option("--set", arguments.assignments, "a value on top of the files, e.g. ndt.cell_size=0.5 (repeatable)")
      ->type_name("SECTION.KEY=VALUE")
      ->allow_extra_args(false);
  app.add_flag("--dry-run", arguments.dry_run, "check everything, print what would run, and stop");
  return app.add_option("-c,--config", arguments.files, "INI file; later ones add sections (repeatable)")
      ->type_name("FILE")
      ->allow_extra_args(false);
}

CLI::Option* addOutputFolder(CLI::App& app, OutputFolderArguments& arguments)
{
  addOverwrite(app, arguments.overwrite);
  return app.add_option("--out-dir", arguments.folder, "folder of the results, created if it is missing")
      ->type_name("DIR");
}

void refuseExisting(const OutputFolderArguments& arguments, const std::vector<std::string>& names)
{
  const auto& folder = arguments.folder;
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder))
    throw UsageError("--out-dir " + folder.string() + ": is not a folder");

  std::vector<std::filesystem::path> files;
  for (const std::string& name : names) files.push_back(folder / name);
  refuseExisting(files, arguments.overwrite);
}

CLI::Option* addSeconds(CLI::App& app, double& seconds)
{
  return app.add_option("--seconds", seconds, "live: stop after so long; 0: when interrupted")
      ->check(CLI::NonNegativeNumber);
}

void refuseSeconds(double seconds)
{
  if (seconds > 0) throw UsageError("--seconds is for live lidars: captures and simulated drives end by themselves");
}

CLI::Option* addOverwrite(CLI::App& app, bool& overwrite)
{
  return app.add_flag("-w,--overwrite", overwrite, "replace outputs that exist");
}

CLI::Option* addJson(CLI::App& app, bool& json) { return app.add_flag("--json", json, "results as JSON on stdout"); }

CLI::Option* addSeed(CLI::App& app, std::uint64_t& seed)
{
  return app.add_option("--seed", seed, "of the random numbers")->capture_default_str();
}

ConfigurationArguments withScene(ConfigurationArguments arguments, const SceneArguments& scene)
{
  if (scene.given()) arguments.files.push_back(scene.file);
  return arguments;
}

CLI::Option* addScene(CLI::App& app, SceneArguments& arguments)
{
  addSeed(app, arguments.seed);
  return app
      .add_option("--simulate", arguments.file,
                  "a simulation's INI file: its packets are made on the way, in place of captures and sockets")
      ->check(CLI::ExistingFile);
}

CLI::Option* addJobs(CLI::App& app, int& jobs)
{
  return app.add_option("--jobs", jobs, "threads or processes at once; 0: one per core")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

CLI::Option* addVerbosity(CLI::App& app, mrpt::system::VerbosityLevel& level)
{
  using namespace mrpt::system;
  const std::map<std::string, VerbosityLevel> levels{
      {"debug", LVL_DEBUG}, {"info", LVL_INFO}, {"warn", LVL_WARN}, {"error", LVL_ERROR}};
  app.add_flag_callback(
      "-q,--quiet", [&level] { level = LVL_ERROR; }, "errors only, no progress");
  return app.add_option("-v,--verbosity", level, "of the log on stderr: debug, info, warn or error")
      ->type_name("LEVEL")
      ->transform(CLI::CheckedTransformer(levels, CLI::ignore_case).description(""));
}
}  // namespace scanloom
