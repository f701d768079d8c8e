/** `scanloom experiment`: a sweep over stands, lidars, N, seeds and any parameter, each drive simulated once, a process
 * per run. */
#include "Arguments.h"
#include "DriveRecording.h"
#include "Interruption.h"
#include "Progress.h"
#include "Settings.h"
#include "Sweep.h"
#include "Verb.h"
#include "Version.h"
#include "config/AtomicFile.h"
#include "simulation/RecordingOptions.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

namespace scanloom
{
namespace
{
struct ExperimentArguments
{
  ConfigurationArguments configuration;
  OutputFolderArguments output;
  int jobs = 0;
  bool resume = false;
  std::string engine = "local";
  std::size_t only = 0;  // 0: all
};

constexpr const char* kCsv = "results.csv";
constexpr const char* kJson = "results.json";
constexpr const char* kConfigurationName = "configuration.ini";

using Records = std::vector<std::optional<RunRecord>>;

/** A name that no verb knows would fail every run. */
void checkSettings(const ExperimentPlan& plan)
{
  const Schema known = knownToAnyVerb();
  for (const PlannedRun& run : plan.runs)
  {
    Configuration configuration;
    for (const auto& [name, value] : run.settings) configuration.set(name + '=' + value);
    configuration.refuseUnknown(known);
  }
}

std::vector<RunRecord> plannedRecords(const ExperimentPlan& plan)
{
  std::vector<RunRecord> records;
  for (const PlannedRun& run : plan.runs)
  {
    RunRecord record;
    record.run = run;
    record.version = programVersion();
    record.configuration_hash = configurationHash(run, plan, record.version);
    records.push_back(std::move(record));
  }
  return records;
}

/** As one would type it where this one was typed. */
Command commandOf(const std::string& program, const ExperimentArguments& arguments)
{
  Command command{{program, "experiment"}, {}};
  for (const auto& file : arguments.configuration.files) command.words.insert(command.words.end(), {"-c", file});
  for (const std::string& assignment : arguments.configuration.assignments)
    command.words.insert(command.words.end(), {"--set", assignment});
  command.words.insert(command.words.end(), {"--out-dir", arguments.output.folder});
  return command;
}

/** Its copy beside the results does not lie where the original's paths are seen from. */
ExperimentOptions withAbsolutePaths(ExperimentOptions options, const ExperimentPlan& plan)
{
  const auto absolute = [](const std::vector<std::filesystem::path>& paths)
  {
    std::vector<std::string> words;
    for (const auto& path : paths) words.push_back(std::filesystem::absolute(path).string());
    return fmt::format("{}", fmt::join(words, " "));
  };
  options.simulations = absolute(plan.simulations);
  options.recordings = absolute(plan.recordings);
  options.configurations = absolute(plan.configurations);
  return options;
}

/** What repeats the sweep. */
std::string iniOf(const Loaded<ExperimentSettings>& loaded)
{
  std::string text = toIni(loaded);
  for (const std::string& section : sectionsForRuns(loaded.configuration))
    if (!loaded.configuration.isSensor(section)) text += toIni(section, loaded.configuration);
  return text;
}

double durationOf(const PlannedDrive& drive)
{
  constexpr double kAssumed = 60;  // s, of a recording
  if (!drive.simulated()) return kAssumed;
  Configuration configuration = Configuration::fromFiles({drive.simulation});
  for (const auto& [name, value] : drive.settings) configuration.set(name + '=' + value);
  return readSettings<SimulationSettings>(configuration, knownToAnyVerb()).drive.duration;
}

/** Simulations, and runs that take as long as those before them, or a share of their drives. */
double estimate(const std::vector<RunRecord>& planned, const std::vector<PlannedDrive>& drives, const Records& done,
                int jobs)
{
  constexpr double kSimulation = 0.4, kEveryScan = 0.1;  // of the drive, two lidars of 32 beams at 512x10 on one core
  double spent = 0, count = 0;
  for (const auto& record : done)
    if (record && record->costs)
    {
      spent += record->costs->elapsed;
      ++count;
    }
  double ahead = 0;
  for (const PlannedDrive& drive : drivesAhead(drives, done))
  {
    const double duration = durationOf(drive);
    if (drive.simulated()) ahead += kSimulation * duration;
    for (const std::size_t run : drive.runs)
      ahead += count > 0 ? spent / count : kEveryScan * duration / planned[run].run.every_nth;
  }
  return ahead / jobs;
}

std::optional<RunRecord> finishedBefore(const RunRecord& planned, const ExperimentFolder& folder)
{
  auto record = recordOf(planned, folder);
  if (record && !record->finished()) record.reset();
  return record;
}

int listRuns(const std::vector<RunRecord>& planned, const std::vector<PlannedDrive>& drives, const Records& done,
             const ExperimentFolder& folder, int jobs)
{
  std::size_t simulations = 0;
  for (const PlannedDrive& drive : drives)
  {
    const auto path = folder.of(drive);
    if (drive.simulated() && !drivesAhead({drive}, done).empty())
    {
      fmt::print("{}\n", toText(simulateCommand(drive, path)));
      ++simulations;
    }
    for (const std::size_t run : drive.runs)
      fmt::print("{}{}\n", done[run] ? "# done: " : "",
                 toText(slamCommand(planned[run].run, folder, path, folder.of(planned[run]))));
  }
  fmt::print("# {} simulations, {} runs, about {} with {} jobs\n", simulations, planned.size(),
             timeText(estimate(planned, drives, done, jobs)), jobs);
  return kDone;
}

int report(const std::vector<RunRecord>& records, std::size_t planned, const std::filesystem::path& folder)
{
  const auto failed =
      std::count_if(records.begin(), records.end(), [](const RunRecord& record) { return !record.finished(); });
  const auto lost =
      std::count_if(records.begin(), records.end(), [](const RunRecord& record) { return record.lost(); });
  fmt::print("{} of {} runs, {} failed, {} lost\n{}\n", records.size(), planned, failed, lost,
             (folder / kCsv).string());
  if (interrupted()) return kInterrupted;
  return failed > 0 ? kSomeFailed : kDone;
}

/** Beside the folder, so that scripts find the newest one. */
void pointLatestTo(const std::filesystem::path& folder)
{
  const auto target = std::filesystem::absolute(folder / "").parent_path();
  const auto link = target.parent_path() / "latest";
  std::error_code error;
  if (std::filesystem::is_symlink(link)) std::filesystem::remove(link, error);
  if (!std::filesystem::exists(link)) std::filesystem::create_directory_symlink(target.filename(), link, error);
}

/** A job of an array: its records are collected by who started the array. */
int runOne(const std::vector<RunRecord>& planned, const std::vector<PlannedDrive>& drives,
           const ExperimentFolder& folder, std::size_t number)
{
  if (number > drives.size()) throw UsageError(fmt::format("--only {}: there are {} drives", number, drives.size()));
  catchInterruption();
  Records done;
  for (const RunRecord& record : planned) done.push_back(recordOf(record, folder));
  bool all = true;
  for (const PlannedDrive& drive : drivesAhead({drives[number - 1]}, done))
    for (const RunRecord& record : runDrive(drive, planned, folder))
    {
      fmt::print("{}: {} {}\n", record.run.label(), record.outcome, record.error);
      all &= record.finished();
    }
  return interrupted() ? kInterrupted : all ? kDone : kSomeFailed;
}

int run(const ExperimentArguments& arguments)
{
  auto loaded = load<ExperimentSettings>(arguments.configuration);
  const ExperimentPlan plan = planOf(loaded.settings, loaded.configuration);
  checkSettings(plan);
  const std::vector<RunRecord> planned = plannedRecords(plan);
  const std::vector<PlannedDrive> drives = drivesOf(plan.runs, programVersion());
  const ExperimentOptions& options = loaded.settings.experiment;
  const ExperimentFolder folder{arguments.output.folder, plan.configurations, options.keep_maps, options.keep_packets};
  if (arguments.only > 0) return runOne(planned, drives, folder, arguments.only);

  OutputFolderArguments output = arguments.output;
  output.overwrite |= arguments.resume || arguments.configuration.dry_run;
  refuseExisting(output, {kCsv, kJson, kConfigurationName});

  Records done(planned.size());
  if (arguments.resume)
    std::transform(planned.begin(), planned.end(), done.begin(),
                   [&](const RunRecord& record) { return finishedBefore(record, folder); });
  const int jobs = arguments.jobs > 0 ? arguments.jobs : std::max(1, static_cast<int>(ourCores().size()));
  if (arguments.configuration.dry_run) return listRuns(planned, drives, done, folder, jobs);

  catchInterruption();
  std::filesystem::create_directories(output.folder);
  loaded.settings.experiment = withAbsolutePaths(loaded.settings.experiment, plan);
  writeAtomically(output.folder / kConfigurationName, [&](std::ostream& file) { file << iniOf(loaded); });
  pointLatestTo(output.folder);
  Sweep sweep{planned, std::move(done), drives, folder, {toText(commandOf("scanloom", arguments)), thisMachine(), {}}};
  const std::vector<RunRecord> records =
      arguments.engine == "slurm" ? runOnSlurm(std::move(sweep), commandOf(ownExecutable(), arguments), arguments.jobs)
                                  : runOnCores(std::move(sweep), jobs);
  return report(records, planned.size(), output.folder);
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<ExperimentArguments>();
  addConfiguration(app, arguments->configuration)->required();
  addOutputFolder(app, arguments->output)->required();
  addJobs(app, arguments->jobs);
  app.add_flag("--resume", arguments->resume, "keeps runs that are done with the same version, files and parameters");
  app.add_option("--engine", arguments->engine,
                 "local, or slurm: a job array by sbatch; the folder must be one that its nodes share")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->capture_default_str();
  app.add_option("--only", arguments->only,
                 "the N-th drive of the plan with those of its runs that have no record, without the tables: for "
                 "job arrays")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb experimentVerb()
{
  return {"experiment", "a sweep of simulated or recorded drives over lidars, N, seeds and parameters",
          schemaOf<ExperimentSettings>(), &addOptions};
}
}  // namespace scanloom
