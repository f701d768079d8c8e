/** `scanloom slam`: trajectory and maps from a recording or live lidars. */
#include "Arguments.h"
#include "Ros2.h"
#include "Settings.h"
#include "SlamInput.h"
#include "SlamOutcome.h"
#include "Verb.h"
#include "Version.h"
#include "Web.h"
#include "base/core/ConfigError.h"
#include "base/core/Interruption.h"
#include "base/core/OutputFile.h"
#include "base/core/OutputFolder.h"
#include "estimation/slam/MapNearby.h"
#include "input/rig/InputDisplay.h"
#include "input/rig/RigOptions.h"
#include "run/run/GivenMap.h"
#include "run/run/SlamFiles.h"
#include "run/run/SlamRun.h"
#include "warn.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <memory>
#include <utility>

namespace scanloom
{
namespace
{
struct SlamArguments
{
  ConfigurationArguments configuration;
  OutputFolderArguments output;
  RecordingArguments recording;
  WebArguments web;
  Ros2Arguments ros2;
  std::vector<std::string> lidars;
  std::filesystem::path map;  // empty: none
  std::string at;             // empty: anywhere in the map
  bool grow = false;
  int every_nth = 0;
  double seconds = 0;  // live lidars; 0: until it is interrupted
};

constexpr const char* kConfigurationFile = "configuration.ini";

/** The command that repeats the run. --every-nth is among the assignments. */
std::string commandOf(const SlamArguments& arguments)
{
  std::string command = "scanloom slam";
  for (const auto& file : arguments.configuration.files) command += fmt::format(" -c {}", file.string());
  for (const std::string& assignment : arguments.configuration.assignments)
    command += fmt::format(" --set {}", assignment);
  for (const auto& path : arguments.recording.paths) command += " " + path.string();
  for (const auto& file : arguments.recording.metadata) command += fmt::format(" --metadata {}", file.string());
  if (!arguments.lidars.empty()) command += fmt::format(" --lidars {}", fmt::join(arguments.lidars, ","));
  if (!arguments.map.empty()) command += fmt::format(" --map {}", arguments.map.string());
  if (!arguments.at.empty()) command += fmt::format(" --at '{}'", arguments.at);
  if (arguments.grow) command += " --grow";
  if (arguments.seconds > 0) command += fmt::format(" --seconds {}", arguments.seconds);
  if (arguments.ros2.given()) command += fmt::format(" --ros2={}", arguments.ros2.name_space);
  return command + fmt::format(" --out-dir {}", arguments.output.folder.string());
}

GivenMap givenMap(const SlamArguments& arguments, const SlamSettings& settings)
{
  if (arguments.map.empty()) return {};
  return readGivenMap(arguments.map, arguments.at, settings);
}

/** What does not go together with --map, which is not changed by those who are localised in it. */
void refuseWrongMap(const SlamArguments& arguments, const OutputOptions& output)
{
  if (!arguments.at.empty() && arguments.map.empty())
    throw UsageError("--at is a pose in the map of an earlier run: name its folder with --map");
  if (arguments.grow && arguments.map.empty())
    throw UsageError("--grow adds to the map of an earlier run: name its folder with --map");
  if (arguments.grow && !output.maps) throw UsageError("--grow writes a map: set output.maps = true");
  std::error_code none;
  if (!arguments.map.empty() && std::filesystem::equivalent(arguments.map, arguments.output.folder, none))
    throw UsageError(fmt::format("{} is the map: choose another --out-dir", arguments.map.string()));
}

InputDisplay displayOf(const SlamInput& input, SensorInput& sensors)
{
  if (input.live) return {"slam", sensors};
  return {"slam", sensors, input.megabytes, "MB"};
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
  if (const std::string poses = unsoundPoses(s); !poses.empty()) warn(poses + ": see trajectory.csv");
  if (!s.marks.empty()) fmt::print("{} events were marked: see trajectory.csv\n", s.marks.size());
  fmt::print("{}\n", (folder / "trajectory.tum").string());
}

SlamRunResult runShowingProgress(const SlamInput& input, const SlamVerbSettings& settings, SlamFiles& files,
                                 const SlamArguments& arguments, const GivenMap& map, const Ros2* ros2)
{
  bool told_of_map = false;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const std::unique_ptr<Web> web =
      openWeb(arguments.web, {"slam", input.live, true}, *input.sensors, arguments.output.folder.parent_path());
  SensorInput& watched = web ? web->input() : *input.sensors;
  const std::unique_ptr<RosTopics> topics = ros2 ? ros2->publish(true) : nullptr;
  const std::unique_ptr<SensorInput> sent = topics ? published(watched, *topics, input.live) : nullptr;
  SensorInput& sensors = sent ? *sent : watched;
  InputDisplay display = displayOf(input, sensors);
  MapNearby map_nearby(map.map);
  SlamRunResult result = runSlam(
      sensors, settings,
      [&](const StateEstimate& estimate)
      {
        files.add(estimate);
        if (web) web->feed().add(estimate);
        if (topics) topics->add(estimate);
        if (!web && !topics) return;
        const std::optional<Keyframe> of_map = map_nearby.next(estimate);
        if (of_map && web) web->feed().addMap(*of_map);
        if (of_map && topics) topics->addMap(*of_map);
      },
      [&](const RunProgress& progress)
      {
        display.update(progress.share, progress.scans, {progress.recorded, progress.busy});
        if (progress.found_after && !std::exchange(told_of_map, true))
          display.say(fmt::format("found in the map after {:.1f} s", seconds(*progress.found_after)));
        if (web) web->update({progress.recorded, progress.busy});
        const bool over = arguments.seconds > 0 && Clock::now() - start >= fromSeconds(arguments.seconds);
        if (input.live && (over || interrupted())) input.sensors->stop();
        return input.live || !interrupted();
      },
      [&](const std::string& warning)
      {
        display.warn(warning);
        if (web) web->feed().warn(warning);
      },
      [&](const EventMark& mark) { files.add(mark); }, map);
  if (web) web->feed().end();
  return result;
}

/** Who interrupts lidars has all that there was; a recording goes on behind. */
Completeness completenessOf(const SlamRunResult& result, const SlamInput& input)
{
  const bool stopped = interrupted() && !input.live;
  return stopped || !result.summary.error.empty() ? Completeness::Partial : Completeness::Whole;
}

int statusOf(const SlamRunResult& result)
{
  if (!result.summary.error.empty()) return kFailed;
  if (interrupted()) return kInterrupted;
  return isGood(result) ? kDone : kQualityGate;
}

int process(const SlamInput& input, const SlamArguments& arguments, const Loaded<SlamVerbSettings>& loaded,
            const std::vector<std::string>& names, const Ros2* ros2)
{
  const SlamVerbSettings& settings = loaded.settings;
  OutputFolder folder(arguments.output.folder);
  writeAtomically(folder.running() / kConfigurationFile, [&](std::ostream& file) { file << toIni(loaded); });
  SlamFiles files(folder.running(), input.sensors->setup().header.lidars, settings.output);
  const GivenMap map = givenMap(arguments, settings);
  if (arguments.grow) files.grow(keyframesOf(arguments.map), map.map->lidars());
  SlamRunResult result =
      withSensorsNotUsed(runShowingProgress(input, settings, files, arguments, map, ros2), loaded.sensors.not_used);
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
  warnIfAny(droppedScans(result.summary));
  for (const std::string& warning : input.sensors->takeWarnings()) warn(warning);
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

SlamInput inputOf(const RecordingFiles& recording, const SlamArguments& arguments,
                  const Loaded<SlamVerbSettings>& loaded, const Ros2* ros2)
{
  InputSource source = sourceOf(recording, loaded.configuration, arguments.lidars);
  if (ros2) source.rig = ros2->live(std::move(source.rig));
  return openForSlam(source, loaded.configuration);
}

int run(SlamArguments arguments)
{
  if (arguments.web.given()) webAddress(arguments.web);  // it may have swallowed the recording
  if (arguments.every_nth > 0)
    arguments.configuration.assignments.push_back(fmt::format("slam.every_nth={}", arguments.every_nth));
  if (arguments.output.folder.empty()) arguments.output.folder = defaultFolder(arguments.recording);
  const std::unique_ptr<Ros2> ros2 = openRos2(arguments.ros2, "slam", arguments.configuration, arguments.recording);
  const RecordingFiles recording = filesOf(arguments.recording, ros2.get());
  const Loaded<SlamVerbSettings> loaded = load<SlamVerbSettings>(arguments.configuration, recording);
  std::vector<std::string> names{kConfigurationFile};
  for (std::string& name : SlamFiles::names(loaded.settings.output)) names.push_back(std::move(name));
  refuseExisting(arguments.output, names);
  refuseWrongMap(arguments, loaded.settings.output);
  const SlamInput input = inputOf(recording, arguments, loaded, ros2.get());
  if (!input.live) refuseSeconds(arguments.seconds);
  if (arguments.configuration.dry_run)
  {
    refuseUnknownImu(*input.sensors, loaded.settings.slam);
    std::cout << toIni(loaded);
    return kDone;
  }
  catchInterruption();
  return process(input, arguments, loaded, names, ros2.get());
}

std::function<int()> addSlamOptions(CLI::App& app)
{
  auto arguments = std::make_shared<SlamArguments>();
  addConfiguration(app, arguments->configuration);
  addDryRun(app, arguments->configuration);
  addOutputFolder(app, arguments->output);
  addRecording(app, arguments->recording);
  addOption(app, "--lidars", arguments->lidars, "names of the lidars to use, separated by commas; default: all")
      .commaSeparated();
  addOption(app, "--map", arguments->map,
            "result folder of an earlier slam: localise in its map, where the recording is searched until it is found; "
            "the map is not changed")
      .typeName("FOLDER")
      .existingFolder();
  addOption(app, "--at", arguments->at,
            "where in the map the body starts, within 6 m and 30 deg: \"x y z yaw pitch roll\" (m, deg), or the last "
            "pose of a .tum file")
      .typeName("POSE");
  addFlag(app, "--grow", arguments->grow,
          "write the map with what is new in it: the keyframes of --map and the drive's own");
  addSeconds(app, arguments->seconds);
  addWeb(app, arguments->web);
  addRos2(app, arguments->ros2);
  addOption(app, "--every-nth", arguments->every_nth, "use every N-th scan only; the IMU is used in full").positive();
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb slamVerb()
{
  Schema schema = rigSchema("lidars");
  merge(schema, schemaOf<SlamVerbSettings>());
  return {"slam", "trajectory, keyframes and maps from a recording or live lidars", schema, &addSlamOptions};
}
}  // namespace scanloom
