/** `scanloom slam`: trajectory and maps from a recording, a simulated drive or live lidars. */
#include "Arguments.h"
#include "Settings.h"
#include "Verb.h"
#include "Version.h"
#include "core/AtomicFile.h"
#include "core/ConfigError.h"
#include "core/Interruption.h"
#include "core/ResultFolder.h"
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
#include <fmt/ranges.h>

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
  RecordingArguments recording;
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

constexpr const char* kConfigurationFile = "configuration.ini";

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

Input openInput(const SlamArguments& arguments, const RecordingFiles& files, const Configuration& configuration)
{
  if (!files.rawlogs.empty())
    return {readAhead(std::make_unique<RawlogInput>(files.rawlogs.front(), arguments.lidars))};
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
  for (const auto& path : arguments.recording.paths) command += " " + path.string();
  for (const auto& file : arguments.recording.metadata) command += fmt::format(" --metadata {}", file.string());
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

SlamRunResult runShowingProgress(const Input& input, const SlamVerbSettings& settings, SlamFiles& files, double longest)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  InputDisplay display = displayOf(input);
  return runSlam(
      *input.sensors, settings, files,
      [&](const RunProgress& progress)
      {
        display.update(progress.share, progress.scans, {progress.recorded, progress.busy});
        const bool over = longest > 0 && Clock::now() - start >= fromSeconds(longest);
        if (input.live && (over || interrupted())) input.sensors->stop();
        return input.live || !interrupted();
      },
      [](const std::string& warning) { fmt::print(stderr, "warning: {}\n", warning); });
}

/** Who interrupts lidars has all that there was; recordings and simulated drives go on behind. */
Completeness completenessOf(const SlamRunResult& result, const Input& input)
{
  const bool stopped = interrupted() && !input.live;
  return stopped || !result.summary.error.empty() ? Completeness::Partial : Completeness::Whole;
}

int statusOf(const SlamRunResult& result)
{
  if (!result.summary.error.empty()) return kFailed;
  if (interrupted()) return kInterrupted;
  const auto damaged = result.summary.counts.find(kDamagedInputs);
  const bool read_whole = damaged == result.summary.counts.end() || damaged->second == 0;
  return result.passed && read_whole ? kDone : kQualityGate;
}

int process(const Input& input, const SlamArguments& arguments, const Loaded<SlamVerbSettings>& loaded,
            const std::vector<std::string>& names)
{
  const SlamVerbSettings& settings = loaded.settings;
  ResultFolder folder(arguments.output.folder);
  writeAtomically(folder.running() / kConfigurationFile, [&](std::ostream& file) { file << toIni(loaded); });
  SlamFiles files(folder.running(), input.sensors->setup().header.lidars,
                  settings.output.maps ? std::optional(settings.octomap) : std::nullopt);
  SlamRunResult result = runShowingProgress(input, settings, files, arguments.seconds);
  result.summary.command = commandOf(arguments);
  if (input.live) result.summary.waited = 1e-3 * result.summary.stages.at("input").total_ms;
  result.summary.versions = {{"scanloom", programVersion()}};
  try
  {
    result.summary = files.close(result.summary);
  }
  catch (const std::exception&)
  {
    fmt::print(stderr, "what could be written is in {}\n", folder.commit(names, Completeness::Partial).string());
    throw;
  }
  const std::filesystem::path kept = folder.commit(names, completenessOf(result, input));

  report(result, kept);
  warnOfDroppedScans(result.summary);
  for (const std::string& warning : input.sensors->takeWarnings()) fmt::print(stderr, "warning: {}\n", warning);
  if (!result.summary.error.empty()) fmt::print(stderr, "scanloom slam: {}\n", result.summary.error);
  if (kept != arguments.output.folder)
    fmt::print(stderr, "the results are not whole: they are in {} and replace none of an earlier run\n", kept.string());
  return statusOf(result);
}

std::filesystem::path defaultFolder(const RecordingArguments& recording)
{
  if (!recording.given())
    throw UsageError("--out-dir is required where no RECORDING is given: name a folder for results");
  return besideRecording(recording, "_slam");
}

int run(SlamArguments arguments)
{
  if (arguments.every_nth > 0)
    arguments.configuration.assignments.push_back(fmt::format("slam.every_nth={}", arguments.every_nth));
  const RecordingFiles recording = arguments.recording.given() ? filesOf(arguments.recording) : RecordingFiles{};
  if (arguments.output.folder.empty()) arguments.output.folder = defaultFolder(arguments.recording);
  const Loaded<SlamVerbSettings> loaded =
      load<SlamVerbSettings>(withScene(arguments.configuration, arguments.scene), recording);
  std::vector<std::string> names{kConfigurationFile};
  for (std::string& name : SlamFiles::names()) names.push_back(std::move(name));
  refuseExisting(arguments.output, names);
  const Input input = openInput(arguments, recording, loaded.configuration);
  if (!input.live) refuseSeconds(arguments.seconds);
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }
  catchInterruption();
  return process(input, arguments, loaded, names);
}

std::function<int()> addSlamOptions(CLI::App& app)
{
  auto arguments = std::make_shared<SlamArguments>();
  addConfiguration(app, arguments->configuration);
  addOutputFolder(app, arguments->output);
  addScene(app, arguments->scene).excludes(addRecording(app, arguments->recording, "RECORDING,-i,--input"));
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
