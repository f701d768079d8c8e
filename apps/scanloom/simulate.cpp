/** `scanloom simulate`: a recording of a machine that drives among stems, as raw packets with the truth beside them. */
#include "Arguments.h"
#include "Interruption.h"
#include "Progress.h"
#include "Settings.h"
#include "Verb.h"
#include "config/AtomicFile.h"
#include "config/ConfigError.h"
#include "simulation/RecordingFolder.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct SimulateArguments
{
  ConfigurationArguments configuration;
  OutputFolderArguments output;
  std::uint64_t seed = 1;
};

/** Ends a recording that nobody waits for any more: half of one would only mislead. */
struct Interrupted : std::exception
{
};

constexpr const char* kConfigurationCopy = "configuration.ini";

/** What is within the bounds of each option and yet impossible together is a wrong configuration, too. */
Scene sceneOf(const SimulationSettings& settings, std::uint64_t seed)
{
  try
  {
    return makeScene(settings, seed);
  }
  catch (const std::invalid_argument& error)
  {
    throw UsageError(error.what());
  }
}

int run(const SimulateArguments& arguments)
{
  const Loaded<SimulationSettings> loaded = load<SimulationSettings>(arguments.configuration);
  std::vector<std::string> names = recordingFileNames();
  names.emplace_back(kConfigurationCopy);
  refuseExisting(arguments.output, names);
  const Scene scene = sceneOf(loaded.settings, arguments.seed);
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }

  catchInterruption();
  const std::filesystem::path& folder = arguments.output.folder;
  std::filesystem::create_directories(folder);
  Progress progress("simulate", static_cast<std::uint64_t>(std::ceil(scene.span.duration)), "s");
  try
  {
    writeRecording(scene, folder,
                   [&](double share)
                   {
                     progress.update(static_cast<std::uint64_t>(std::llround(share * scene.span.duration)));
                     if (interrupted()) throw Interrupted();
                   });
  }
  catch (const Interrupted&)
  {
    return kInterrupted;
  }
  writeAtomically(folder / kConfigurationCopy, [&](std::ostream& file) { file << toIni(loaded); });
  std::cout << folder.string() << '\n';
  return kDone;
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
            addOutputFolder(app, arguments->output)->required();
            addSeed(app, arguments->seed);
            return [arguments] { return run(*arguments); };
          }};
}
}  // namespace scanloom
