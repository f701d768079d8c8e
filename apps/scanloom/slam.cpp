/** `scanloom slam`: trajectory and maps of a recording. */
#include "Arguments.h"
#include "Interruption.h"
#include "Progress.h"
#include "Settings.h"
#include "Verb.h"
#include "config/AtomicFile.h"
#include "output/SlamRun.h"
#include "source/RigOptions.h"

#include <fmt/format.h>

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
  std::filesystem::path rawlog;
  std::vector<std::string> lidars;
  int every_nth = 0;
  std::string command;
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

std::unique_ptr<SensorInput> openInput(const SlamArguments& arguments, const Configuration& configuration)
{
  if (!arguments.rawlog.empty()) return makeRawlogInput(arguments.rawlog, arguments.lidars);
  const RigSettings rig = readRigSettings(configuration, rigSection(configuration));
  if (rig.rig.pcap_input.empty())
    throw ConfigError(fmt::format("[{}] pcap_input is missing: nothing to read (or give a rawlog by --input)",
                                  rigSection(configuration)));
  return makeCaptureInput(makeRig(rig, arguments.lidars));
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
  const Loaded<SlamVerbSettings> loaded = load<SlamVerbSettings>(arguments.configuration);
  std::vector<std::string> names = SlamFiles::names();
  names.emplace_back(kConfigurationName);
  refuseExisting(arguments.output, names);
  const std::unique_ptr<SensorInput> input = openInput(arguments, loaded.configuration);
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }

  catchInterruption();
  SlamFiles files(arguments.output.folder, input->header().lidars, loaded.settings.octomap);
  writeAtomically(arguments.output.folder / kConfigurationName, [&](std::ostream& file) { file << toIni(loaded); });
  Progress progress("slam", 1000, "permille");
  SlamRunResult result = runSlam(*input, loaded.settings, files,
                                 [&progress](double share, std::uint64_t)
                                 {
                                   progress.update(static_cast<std::uint64_t>(1000 * share));
                                   return !interrupted();
                                 });
  result.summary.command = arguments.command;
  result.summary.versions = {{"scanloom", SCANLOOM_VERSION}};
  files.close(result.summary);

  report(result, arguments.output.folder);
  if (const std::string damage = input->damage(); !damage.empty()) fmt::print(stderr, "warning: {}\n", damage);
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
