/** `scanloom simulate`: raw packets of a machine that drives through a simulated forest, with ground truth. */
#include "Arguments.h"
#include "Settings.h"
#include "Verb.h"
#include "base/core/ConfigError.h"
#include "base/core/Interruption.h"
#include "base/core/OutputFile.h"
#include "base/core/OutputFolder.h"
#include "base/core/Progress.h"
#include "lab/simulation/RecordingFolder.h"
#include "lab/simulation/ScenePictures.h"
#include "lab/simulation/SceneSensors.h"
#include "lab/simulation/checkedScene.h"
#include "lab/whole_turns/replaceByTurns.h"

#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <thread>

namespace scanloom
{
namespace
{
struct SimulateArguments
{
  ConfigurationArguments configuration;
  OutputFolderArguments output;
  std::uint64_t seed = 1;
  bool udp = false;
  std::string pictures;
};

void refuseUnknownTurns(const SimulatedRecordingOptions& recording)
try
{
  if (!recording.packets()) turnGroupingFromName(recording.whole_turns);
}
catch (const std::invalid_argument& problem)
{
  throw ConfigError(fmt::format("[simulated_recording] whole_turns = {}", problem.what()));
}

constexpr const char* kConfigurationCopy = "configuration.ini";

int write(const Scene& scene, const Loaded<SimulationSettings>& loaded, const std::filesystem::path& out,
          const std::vector<std::string>& names)
{
  OutputFolder folder(out);
  Progress progress("simulate", static_cast<std::uint64_t>(std::ceil(scene.span.duration)), "s");
  try
  {
    writeRecording(scene, folder.running(),
                   [&](double share)
                   {
                     progress.update(static_cast<std::uint64_t>(std::llround(share * scene.span.duration)));
                     throwIfInterrupted();
                   });
  }
  catch (const Interrupted&)
  {
    return kInterrupted;
  }
  if (const SimulatedRecordingOptions& recording = loaded.settings.recording; !recording.packets())
    replaceByTurns(folder.running(), turnGroupingFromName(recording.whole_turns));
  writeAtomically(folder.running() / kConfigurationCopy, [&](std::ostream& file) { file << toIni(loaded); });
  std::cout << folder.commit(names, Completeness::Whole).string() << '\n';
  return kDone;
}

/** At half of the drive's time. */
int draw(const Scene& scene, const std::filesystem::path& folder)
{
  const double middle = 0.5 * scene.span.duration;
  std::filesystem::create_directories(folder);
  drawStand(scene, middle, folder / "stand.png");
  drawScans(scene, middle, folder / "scans.png");
  std::cout << folder.string() << '\n';
  return kDone;
}

/** Sends the packets over UDP. Prints the section that 'record' needs first. */
int play(const Scene& scene)
{
  constexpr double kUntilListening = 5;  // s from the configuration to the first packet, for who reads it to be started
  SceneSensors sensors(scene);
  std::cout << sensors.configuration() << std::flush;
  for (double waited = 0; waited < kUntilListening && !interrupted(); waited += 0.1) std::this_thread::sleep_for(100ms);
  Progress progress("simulate", static_cast<std::uint64_t>(std::ceil(scene.span.duration)), "s");
  const PlayedScene played = sensors.play(
      [&](double share)
      {
        progress.update(static_cast<std::uint64_t>(std::llround(share * scene.span.duration)));
        return !interrupted();
      });
  fmt::print(stderr, "{} datagrams sent, {} could not be sent, at most {:.1f} ms late\n", played.sent, played.refused,
             1e3 * seconds(played.latest));
  return interrupted() ? kInterrupted : kDone;
}

int run(const SimulateArguments& arguments)
{
  const Loaded<SimulationSettings> loaded = load<SimulationSettings>(arguments.configuration);
  std::vector<std::string> names = recordingFileNames(loaded.settings);
  names.emplace_back(kConfigurationCopy);
  if (arguments.udp + !arguments.output.folder.empty() + !arguments.pictures.empty() != 1)
    throw UsageError(
        "give exactly one of --out-dir (write a recording), --udp (send packets in real time) and --pictures");
  if (!arguments.output.folder.empty()) refuseExisting(arguments.output, names);
  for (const SimulatedLidarOptions& lidar : loaded.settings.lidars)
    for (const std::string& name : names) refuseInputsAsOutputs({lidar.metadata}, {arguments.output.folder / name});
  const Scene scene = checkedScene(loaded.settings, arguments.seed);
  refuseUnknownTurns(loaded.settings.recording);
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }

  if (!arguments.pictures.empty()) return draw(scene, arguments.pictures);
  catchInterruption();
  return arguments.udp ? play(scene) : write(scene, loaded, arguments.output.folder, names);
}
}  // namespace

Verb simulateVerb()
{
  return {"simulate", "a simulated recording: raw packets, IMU, ground truth, total station",
          schemaOf<SimulationSettings>(),
          [](CLI::App& app)
          {
            auto arguments = std::make_shared<SimulateArguments>();
            addConfiguration(app, arguments->configuration);
            addDryRun(app, arguments->configuration);
            addOutputFolder(app, arguments->output);
            addFlag(app, "--udp", arguments->udp,
                    "send the packets in real time to 127.0.0.1, as lidars with HTTP interfaces would; prints the "
                    "configuration for 'record' first");
            addOption(app, "--pictures", arguments->pictures,
                      "draw the forest and one turn of every lidar, at half of the drive's time, into this folder");
            addOption(app, "--seed", arguments->seed, "seed of the random numbers").showDefault();
            return [arguments] { return run(*arguments); };
          }};
}
}  // namespace scanloom
