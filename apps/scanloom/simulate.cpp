/** `scanloom simulate`: a recording of a machine that drives among stems, as raw packets with the truth beside them. */
#include "Arguments.h"
#include "Interruption.h"
#include "Progress.h"
#include "Settings.h"
#include "SimulatedRig.h"
#include "Verb.h"
#include "config/AtomicFile.h"
#include "config/ConfigError.h"
#include "simulation/RecordingFolder.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

namespace scanloom
{
namespace
{
struct SimulateArguments
{
  ConfigurationArguments configuration;
  OutputFolderArguments output;
  std::uint64_t seed = 1;
  double seconds = 0;  // 0: as configured
  int jobs = 0;
};

/** Ends a recording that nobody waits for any more: half of one would only mislead. */
struct Interrupted : std::exception
{
};

constexpr const char* kConfigurationCopy = "configuration.ini";

int run(SimulateArguments arguments)
{
  if (arguments.seconds > 0)
    arguments.configuration.assignments.push_back(fmt::format("simulated_drive.duration={}", arguments.seconds));
  std::optional<tbb::global_control> jobs;
  if (arguments.jobs > 0)
    jobs.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(arguments.jobs));
  const Loaded<SimulationSettings> loaded = load<SimulationSettings>(arguments.configuration);
  std::vector<std::string> names = recordingFileNames(loaded.settings);
  names.emplace_back(kConfigurationCopy);
  refuseExisting(arguments.output, names);
  const Scene scene = checkedScene(loaded.settings, arguments.seed);
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
            app.add_option("--seconds", arguments->seconds, "length of the recording, instead of the configured one")
                ->check(CLI::PositiveNumber);
            addJobs(app, arguments->jobs);
            return [arguments] { return run(*arguments); };
          }};
}
}  // namespace scanloom
