/** `scanloom experiment`: runs slam on every combination of drives, lidars, N, seeds and parameters. */
#include "Arguments.h"
#include "Settings.h"
#include "SweepCheck.h"
#include "Verb.h"
#include "Version.h"
#include "base/core/Interruption.h"
#include "base/core/OutputFile.h"
#include "base/core/Progress.h"
#include "lab/study/DriveRecording.h"
#include "lab/study/Sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

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

/** The command that repeats the sweep in the current folder. */
Command commandOf(const std::string& program, const ExperimentArguments& arguments)
{
  Command command{{program, "experiment"}, {}};
  for (const auto& file : arguments.configuration.files) command.words.insert(command.words.end(), {"-c", file});
  for (const std::string& assignment : arguments.configuration.assignments)
    command.words.insert(command.words.end(), {"--set", assignment});
  command.words.insert(command.words.end(), {"--out-dir", arguments.output.folder});
  return command;
}

/** A configuration that repeats the sweep from any folder. */
std::string iniOf(Loaded<ExperimentSettings> loaded, const ExperimentPlan& plan)
{
  loaded.settings.experiment = withAbsolutePaths(loaded.settings.experiment, plan);
  std::string text = toIni(loaded);
  for (const std::string& section : sectionsForRuns(loaded.configuration))
    if (!loaded.configuration.isSensor(section)) text += toIni(section, loaded.configuration);
  return text;
}

int listRuns(const Sweep& sweep, int jobs)
{
  std::size_t simulations = 0;
  for (const PlannedDrive& drive : sweep.drives)
  {
    const auto path = sweep.folder.of(drive);
    if (drive.simulated() && !remaining({drive}, sweep.finished).empty())
    {
      fmt::print("{}\n", toText(simulateCommand(drive, path)));
      ++simulations;
    }
    for (const std::size_t run : drive.runs)
      fmt::print("{}{}\n", sweep.finished[run] ? "# done: " : "",
                 toText(slamCommand(sweep.planned[run].run, sweep.folder, path, sweep.folder.of(sweep.planned[run]))));
  }
  fmt::print("# {} simulations, {} runs, about {} with {} jobs\n", simulations, sweep.planned.size(),
             timeText(estimatedSeconds(sweep, jobs)), jobs);
  return kDone;
}

/** The work of one job of a job array. The program that started the array collects the records. */
int runOne(const Sweep& sweep, std::size_t number)
{
  if (number > sweep.drives.size())
    throw UsageError(fmt::format("--only {}: there are {} drives", number, sweep.drives.size()));
  catchInterruption();
  FinishedRuns recorded;
  for (const RunRecord& record : sweep.planned) recorded.push_back(recordOf(record, sweep.folder));
  bool all = true;
  for (const PlannedDrive& drive : remaining({sweep.drives[number - 1]}, recorded))
    for (const RunRecord& record : runDrive(drive, sweep.planned, sweep.folder))
    {
      fmt::print("{}: {} {}\n", record.run.label(), record.outcome, record.error);
      all &= record.finished();
    }
  return interrupted() ? kInterrupted : all ? kDone : kSomeFailed;
}

std::vector<RunRecord> runAll(Sweep sweep, const ExperimentArguments& arguments, int jobs)
{
  const ExperimentFolder folder = sweep.folder;
  Progress progress("experiment", sweep.planned.size(), "runs");
  const auto on_run = [&](const RunRecord& record, std::size_t finished)
  {
    if (!record.finished()) fmt::print(stderr, "failed: {}: {}\n", folder.of(record).string(), record.error);
    progress.update(finished);
  };
  if (arguments.engine == "slurm")
    return runOnSlurm(std::move(sweep), commandOf(ownExecutable(), arguments), arguments.jobs, on_run);
  return runOnCores(std::move(sweep), jobs, on_run);
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

int run(const ExperimentArguments& arguments)
{
  const auto loaded = load<ExperimentSettings>(arguments.configuration);
  const ExperimentPlan plan = planOf(loaded.settings, loaded.configuration);
  if (arguments.only == 0) refuseMistakes(plan, loaded.configuration);
  const ExperimentOptions& options = loaded.settings.experiment;
  Sweep sweep{plannedRecords(plan, programVersion()),
              FinishedRuns(plan.runs.size()),
              drivesOf(plan.runs, programVersion()),
              {arguments.output.folder, plan.configurations, options.keep_maps, options.keep_packets},
              {toText(commandOf("scanloom", arguments)), thisMachine(), {}}};
  if (arguments.only > 0) return runOne(sweep, arguments.only);

  OutputFolderArguments output = arguments.output;
  output.overwrite |= arguments.resume || arguments.configuration.dry_run;
  refuseExisting(output, {kCsv, kJson, kConfigurationName});

  if (arguments.resume) sweep.finished = finishedBefore(sweep.planned, sweep.folder);
  const int jobs = arguments.jobs > 0 ? arguments.jobs : std::max(1, static_cast<int>(ourCores().size()));
  if (arguments.configuration.dry_run) return listRuns(sweep, jobs);

  catchInterruption();
  std::filesystem::create_directories(output.folder);
  writeAtomically(output.folder / kConfigurationName, [&](std::ostream& file) { file << iniOf(loaded, plan); });
  pointLatestTo(output.folder);
  return report(runAll(std::move(sweep), arguments, jobs), plan.runs.size(), output.folder);
}

std::function<int()> addExperimentOptions(CLI::App& app)
{
  auto arguments = std::make_shared<ExperimentArguments>();
  addConfiguration(app, arguments->configuration).required();
  addDryRun(app, arguments->configuration);
  addOutputFolder(app, arguments->output).required();
  addOption(app, "--jobs", arguments->jobs, "number of processes; with slurm, of jobs at a time; 0: one per core")
      .notNegative()
      .showDefault();
  addFlag(app, "--resume", arguments->resume,
          "keep the runs that are done with the same version, files and parameters; run the others");
  addOption(app, "--engine", arguments->engine,
            "local: on this computer; slurm: as a job array (sbatch) on nodes that see the folder")
      .oneOf({"local", "slurm"})
      .showDefault();
  addOption(app, "--only", arguments->only,
            "for job arrays: do only the runs of the N-th drive that have no record, and write no tables")
      .typeName("N")
      .positive();
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb experimentVerb()
{
  return {"experiment",
          "slam and evaluate on every combination of drives, lidars, every N-th scan, seeds and parameters",
          schemaOf<ExperimentSettings>(), &addExperimentOptions};
}
}  // namespace scanloom
