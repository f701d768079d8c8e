/** `scanloom slam`: trajectory and maps from a recording, a simulated drive or live lidars. */
#include "Arguments.h"
#include "Settings.h"
#include "Verb.h"
#include "Version.h"
#include "core/AtomicFile.h"
#include "core/Interruption.h"
#include "mrpt_bridge/ImuDriverInput.h"
#include "mrpt_bridge/RawlogInput.h"
#include "mrpt_bridge/configuredImu.h"
#include "rig/InputDisplay.h"
#include "rig/ReadAhead.h"
#include "rig/RigOptions.h"
#include "rig/openRig.h"
#include "run/SlamRun.h"
#include "simulation/SimulatedRig.h"

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
  double seconds = 0;  // live lidars; 0: until it is interrupted
};

struct SlamVerbSettings : SlamSettings
{
  OutputOptions output;
  OctoMapOptions octomap;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    SlamSettings::sections(s, visit);
    visit(s.output, Section{"output", "the files that 'slam' writes"});
    visit(s.octomap, Section{"octomap", "the occupancy map (OctoMap)"});
  }
};

constexpr const char* kConfigurationName = "configuration.ini";

struct Input
{
  std::unique_ptr<SensorInput> sensors;
  std::uint64_t size = 0;  // 0: not known
  const char* unit = "MB";
  bool live = false;
};

Input openLive(const Rig& rig, const Configuration& configuration, const std::string& section)
{
  std::unique_ptr<SensorInput> sensors = openRig(rig);
  if (auto imu = openConfiguredImu(configuration, section))
    sensors = std::make_unique<ImuDriverInput>(std::move(sensors), std::move(imu));
  return {std::move(sensors), 0, "", true};
}

std::unique_ptr<SensorInput> readAhead(std::unique_ptr<SensorInput> input)
{
  return std::make_unique<ReadAhead>(std::move(input));
}

Input openInput(const SlamArguments& arguments, const Configuration& configuration)
{
  if (!arguments.rawlog.empty()) return {readAhead(std::make_unique<RawlogInput>(arguments.rawlog, arguments.lidars))};
  if (arguments.scene.given())
  {
    const SimulatedRig simulated = simulatedRig(configuration, arguments.scene.seed, arguments.lidars);
    return {readAhead(makeSceneInput(simulated.scene, simulated.rig)),
            static_cast<std::uint64_t>(std::ceil(simulated.scene->span.duration)), "s"};
  }
  const std::string section = rigSection(configuration);
  const Rig rig = makeRig(readRigSettings(configuration, section), arguments.lidars);
  if (rig.captures.empty()) return openLive(rig, configuration, section);
  const std::uint64_t megabytes = megabytesOf(rig.captures);
  return {readAhead(openRig(rig)), megabytes};
}

/** The command that repeats the run. --every-nth is among the assignments. */
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
  if (arguments.seconds > 0) command += fmt::format(" --seconds {}", arguments.seconds);
  return command + fmt::format(" --out-dir {}", arguments.output.folder.string());
}

InputDisplay displayOf(const Input& input)
{
  if (input.live) return {"slam", *input.sensors};
  return {"slam", input.size, input.unit};
}

void warnOfDroppedScans(const RunSummary& summary)
{
  const auto dropped = summary.counts.find("scans_dropped");
  if (dropped == summary.counts.end() || dropped->second == 0) return;
  fmt::print(
      stderr,
      "warning: slower than real time: {} scans were dropped, {} processed; use --every-nth, fewer lidars or coarser "
      "maps\n",
      dropped->second, summary.counts.at("scans"));
}

std::string timePerScan(const RunSummary& summary)
{
  const auto scan = summary.stages.find("scan");
  if (scan == summary.stages.end()) return "";
  const StageTime& time = scan->second;
  return fmt::format("; {:.1f} ms per scan, 95 % below {:.1f} ms", time.total_ms / static_cast<double>(time.runs),
                     time.histogram.quantile(0.95));
}

void report(const SlamRunResult& result, const std::filesystem::path& folder)
{
  const RunSummary& s = result.summary;
  const auto count = [&s](const char* name) { return s.counts.at(name); };
  fmt::print(
      "{}: {} poses from {} scans, {} keyframes; {:.1f} s of recording in {:.1f} s (real-time factor {:.1f}{})\n",
      s.outcome, count("poses"), count("scans"), count("keyframes"), s.recorded, s.elapsed, s.realTimeFactor(),
      timePerScan(s));
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
  if (!input.live) refuseSeconds(arguments.seconds);
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }

  catchInterruption();
  const SlamVerbSettings& settings = loaded.settings;
  SlamFiles files(arguments.output.folder, input.sensors->setup().header.lidars,
                  settings.output.maps ? std::optional(settings.octomap) : std::nullopt);
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  writeAtomically(arguments.output.folder / kConfigurationName, [&](std::ostream& file) { file << toIni(loaded); });
  SlamRunResult result;
  {
    InputDisplay display = displayOf(input);
    result = runSlam(
        *input.sensors, settings, files,
        [&](const RunProgress& progress)
        {
          display.update(progress.share, progress.scans, {progress.recorded, progress.busy});
          const bool over = arguments.seconds > 0 && Clock::now() - start >= fromSeconds(arguments.seconds);
          if (input.live && (over || interrupted())) input.sensors->stop();
          return input.live || !interrupted();
        },
        [](const std::string& warning) { fmt::print(stderr, "warning: {}\n", warning); });
  }
  result.summary.command = commandOf(arguments);
  if (input.live) result.summary.waited = 1e-3 * result.summary.stages.at("input").total_ms;
  result.summary.versions = {{"scanloom", programVersion()}};
  files.close(result.summary);

  report(result, arguments.output.folder);
  warnOfDroppedScans(result.summary);
  for (const std::string& warning : input.sensors->takeWarnings()) fmt::print(stderr, "warning: {}\n", warning);
  if (interrupted()) return kInterrupted;
  return result.passed ? kDone : kQualityGate;
}

std::function<int()> addSlamOptions(CLI::App& app)
{
  auto arguments = std::make_shared<SlamArguments>();
  addConfiguration(app, arguments->configuration);
  addOutputFolder(app, arguments->output).required();
  const Option rawlog = addOption(app, "-i,--input", arguments->rawlog,
                                  "a rawlog written by scanloom, instead of the lidars of the configuration")
                            .existingFile();
  addScene(app, arguments->scene).excludes(rawlog);
  addOption(app, "--lidars", arguments->lidars, "names of the lidars to use, separated by commas; default: all")
      .commaSeparated();
  addSeconds(app, arguments->seconds);
  addOption(app, "--every-nth", arguments->every_nth, "use every N-th scan only; the IMU is used in full").positive();
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb slamVerb()
{
  Schema schema = rigSchema("lidars");
  merge(schema, schemaOf<SlamVerbSettings>());
  return {"slam", "trajectory, keyframes and maps from a recording, a simulated drive or live lidars", schema,
          &addSlamOptions};
}
}  // namespace scanloom
