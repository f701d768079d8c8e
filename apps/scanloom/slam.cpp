/** `scanloom slam`: trajectory and maps of a recording. */
#include "Arguments.h"
#include "Interruption.h"
#include "Progress.h"
#include "Settings.h"
#include "SimulatedRig.h"
#include "Verb.h"
#include "config/AtomicFile.h"
#include "output/SlamRun.h"
#include "source/RigOptions.h"

#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct SlamArguments
{
  ConfigurationArguments configuration;
  OutputFolderArguments output;
  SceneArguments scene;
  std::filesystem::path rawlog;
  std::vector<std::string> lidars;
  int every_nth = 0;
};

struct SlamVerbSettings : SlamSettings
{
  OctoMapOptions octomap;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    SlamSettings::sections(s, visit);
    visit(s.octomap, Section{"octomap", "the occupancy map"});
  }
};

constexpr const char* kConfigurationName = "configuration.ini";

struct Input
{
  std::unique_ptr<SensorInput> sensors;
  std::uint64_t size = 0;  // 0: no telling how far it is
  const char* unit = "MB";
};

Input openInput(const SlamArguments& arguments, const Configuration& configuration)
{
  if (!arguments.rawlog.empty()) return {makeRawlogInput(arguments.rawlog, arguments.lidars)};
  if (arguments.scene.given())
  {
    const SimulatedRig simulated = simulatedRig(arguments.scene, configuration, arguments.lidars);
    return {makeSceneInput(simulated.scene, simulated.rig),
            static_cast<std::uint64_t>(std::ceil(simulated.scene->span.duration)), "s"};
  }
  const std::string section = rigSection(configuration);
  Rig rig = makeRig(readRigSettings(configuration, section), arguments.lidars);
  if (rig.captures.empty())
    throw ConfigError(
        fmt::format("[{}] pcap_input is missing: nothing to read (or give a rawlog by --input)", section));
  const std::uint64_t megabytes = megabytesOf(rig.captures);
  return {makeCaptureInput(std::move(rig)), megabytes};
}

/** The line that repeats the run; --every-nth is among the assignments. */
std::string commandOf(const SlamArguments& arguments)
{
  std::string command = "scanloom slam";
  for (const auto& file : arguments.configuration.files) command += fmt::format(" -c {}", file.string());
  for (const std::string& assignment : arguments.configuration.assignments)
    command += fmt::format(" --set {}", assignment);
  if (!arguments.rawlog.empty()) command += fmt::format(" -i {}", arguments.rawlog.string());
  if (arguments.scene.given())
    command += fmt::format(" --simulate {} --seed {}", arguments.scene.file.string(), arguments.scene.seed);
  if (!arguments.lidars.empty()) command += fmt::format(" --lidars {}", fmt::join(arguments.lidars, ","));
  return command + fmt::format(" --out-dir {}", arguments.output.folder.string());
}

void report(const SlamRunResult& result, const std::filesystem::path& folder)
{
  const RunSummary& s = result.summary;
  const auto count = [&s](const char* name) { return s.counts.at(name); };
  fmt::print("{}: {} poses from {} scans, {} keyframes, {:.1f} s of recording in {:.1f} s (real-time factor {:.1f})\n",
             s.outcome, count("poses"), count("scans"), count("keyframes"), s.recorded, s.elapsed, s.realTimeFactor());
  if (count("poses_degenerate") + count("poses_lost") + count("poses_initialising") > 0)
    fmt::print(stderr, "warning: {} poses INITIALISING, {} DEGENERATE, {} LOST: see trajectory.csv\n",
               count("poses_initialising"), count("poses_degenerate"), count("poses_lost"));
  fmt::print("{}\n", (folder / "trajectory.tum").string());
}

int run(SlamArguments arguments)
{
  if (arguments.every_nth > 0)
    arguments.configuration.assignments.push_back(fmt::format("slam.every_nth={}", arguments.every_nth));
  const Loaded<SlamVerbSettings> loaded = load<SlamVerbSettings>(withScene(arguments.configuration, arguments.scene));
  std::vector<std::string> names = SlamFiles::names();
  names.emplace_back(kConfigurationName);
  refuseExisting(arguments.output, names);
  const Input input = openInput(arguments, loaded.configuration);
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }

  catchInterruption();
  SlamFiles files(arguments.output.folder, input.sensors->header().lidars, loaded.settings.octomap);
  writeAtomically(arguments.output.folder / kConfigurationName, [&](std::ostream& file) { file << toIni(loaded); });
  SlamRunResult result;
  {
    Progress progress("slam", input.size, input.size > 0 ? input.unit : "scans");
    result = runSlam(
        *input.sensors, loaded.settings, files,
        [&](double share, std::uint64_t scans)
        {
          progress.update(input.size > 0 ? static_cast<std::uint64_t>(share * static_cast<double>(input.size)) : scans);
          return !interrupted();
        });
  }
  result.summary.command = commandOf(arguments);
  result.summary.versions = {{"scanloom", SCANLOOM_VERSION}};
  files.close(result.summary);

  report(result, arguments.output.folder);
  for (const std::string& warning : input.sensors->takeWarnings()) fmt::print(stderr, "warning: {}\n", warning);
  if (interrupted()) return kInterrupted;
  return result.passed ? kDone : kQualityGate;
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<SlamArguments>();
  addConfiguration(app, arguments->configuration);
  addOutputFolder(app, arguments->output)->required();
  app.add_option("-i,--input", arguments->rawlog, "a rawlog of scanloom's, instead of the configured captures")
      ->check(CLI::ExistingFile);
  addScene(app, arguments->scene)->excludes("--input");
  app.add_option("--lidars", arguments->lidars, "names of the lidars to use, separated by commas")->delimiter(',');
  app.add_option("--every-nth", arguments->every_nth, "use every N-th scan only")->check(CLI::PositiveNumber);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb slamVerb()
{
  Schema schema = rigSchema("lidars");
  merge(schema, schemaOf<SlamVerbSettings>());
  return {"slam", "trajectory, keyframes and maps of a recording", schema, &addOptions};
}
}  // namespace scanloom
