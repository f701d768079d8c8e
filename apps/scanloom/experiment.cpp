/** `scanloom experiment`: a sweep over stands, lidars, N, seeds and any parameter, a process per run. */
#include "Arguments.h"
#include "ExperimentRun.h"
#include "Interruption.h"
#include "Progress.h"
#include "Settings.h"
#include "Verb.h"
#include "config/AtomicFile.h"
#include "simulation/RecordingOptions.h"
#include "study/Study.h"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

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
    record.version = SCANLOOM_VERSION;
    record.configuration_hash = configurationHash(run, plan, SCANLOOM_VERSION);
    records.push_back(std::move(record));
  }
  return records;
}

std::vector<RunRecord> thoseDone(const Records& results)
{
  std::vector<RunRecord> done;
  for (const auto& record : results)
    if (record) done.push_back(*record);
  return done;
}

/** As one would type it where this one was typed. */
std::string commandOf(const ExperimentArguments& arguments)
{
  Command command{{"scanloom", "experiment"}, {}};
  for (const auto& file : arguments.configuration.files) command.words.insert(command.words.end(), {"-c", file});
  for (const std::string& assignment : arguments.configuration.assignments)
    command.words.insert(command.words.end(), {"--set", assignment});
  command.words.insert(command.words.end(), {"--out-dir", arguments.output.folder});
  return toText(command);
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

std::vector<int> ourCores()
{
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return cores;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(core, &set)) cores.push_back(core);
  return cores;
}

/** Each job has cores of its own, which its processes inherit: their times stay comparable. */
void keepToShare(int job, int jobs, const std::vector<int>& cores)
{
  cpu_set_t set;
  CPU_ZERO(&set);
  for (std::size_t i = static_cast<std::size_t>(job); i < cores.size(); i += static_cast<std::size_t>(jobs))
    CPU_SET(cores[i], &set);
  if (CPU_COUNT(&set) > 0) sched_setaffinity(0, sizeof set, &set);
}

class Sweep
{
 public:
  Sweep(const std::vector<RunRecord>& planned, const ExperimentFolder& folder, Study study, Records done)
    : planned_(planned),
      folder_(folder),
      study_(std::move(study)),
      results_(std::move(done)),
      progress_("experiment", planned.size(), "runs")
  {
  }

  /** What is done, in the order of the plan. */
  std::vector<RunRecord> run(int jobs)
  {
    const std::vector<int> cores = ourCores();
    std::vector<std::thread> threads;
    for (int job = 0; job < jobs; ++job)
      threads.emplace_back(
          [&, job]
          {
            keepToShare(job, jobs, cores);
            work();
          });
    for (std::thread& thread : threads) thread.join();
    save();
    return study_.records;
  }

 private:
  void work()
  {
    for (std::size_t i = next_++; i < planned_.size() && !interrupted(); i = next_++)
    {
      if (results_[i]) continue;
      RunRecord record = execute(planned_[i], folder_);
      if (interrupted()) return;  // half a run is none
      add(i, std::move(record));
    }
  }

  void add(std::size_t i, RunRecord record)
  {
    const std::lock_guard lock(mutex_);
    if (!record.finished()) fmt::print(stderr, "failed: {}: {}\n", folder_.of(record).string(), record.error);
    results_[i] = std::move(record);
    save();
    progress_.update(study_.records.size());
  }

  void save()
  {
    study_.records = thoseDone(results_);
    writeStudy(folder_.root, study_);
  }

  const std::vector<RunRecord>& planned_;
  const ExperimentFolder& folder_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;  // for what follows
  Study study_;
  Records results_;
  Progress progress_;
};

double durationOf(const PlannedRun& run)
{
  constexpr double kAssumed = 60;  // s, of a recording
  if (run.simulation.empty()) return kAssumed;
  Configuration configuration = Configuration::fromFiles({run.simulation});
  for (const auto& [name, value] : run.settings) configuration.set(name + '=' + value);
  return readSettings<SimulationSettings>(configuration, knownToAnyVerb()).drive.duration;
}

/** A run takes as long as those before it, or as its drive. */
double estimate(const std::vector<RunRecord>& planned, const Records& done, int jobs)
{
  double spent = 0, count = 0, ahead = 0, left = 0;
  for (std::size_t i = 0; i < planned.size(); ++i)
    if (done[i] && done[i]->costs)
    {
      spent += done[i]->costs->elapsed;
      ++count;
    }
    else
    {
      ahead += durationOf(planned[i].run);
      ++left;
    }
  return (count > 0 ? left * spent / count : ahead) / jobs;
}

int listRuns(const std::vector<RunRecord>& planned, const Records& done, const ExperimentFolder& folder, int jobs)
{
  for (std::size_t i = 0; i < planned.size(); ++i)
    fmt::print("{}{}\n", done[i] ? "# done: " : "", toText(slamCommand(planned[i].run, folder, folder.of(planned[i]))));
  fmt::print("# {} runs, about {} with {} jobs\n", planned.size(), timeText(estimate(planned, done, jobs)), jobs);
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

int run(const ExperimentArguments& arguments)
{
  auto loaded = load<ExperimentSettings>(arguments.configuration);
  const ExperimentPlan plan = planOf(loaded.settings, loaded.configuration);
  checkSettings(plan);
  OutputFolderArguments output = arguments.output;
  output.overwrite |= arguments.resume || arguments.configuration.dry_run;
  refuseExisting(output, {kCsv, kJson, kConfigurationName});

  const std::vector<RunRecord> planned = plannedRecords(plan);
  const ExperimentFolder folder{output.folder, plan.configurations, loaded.settings.experiment.keep_maps};
  Records done(planned.size());
  if (arguments.resume)
    std::transform(planned.begin(), planned.end(), done.begin(),
                   [&](const RunRecord& record) { return finishedBefore(record, folder); });
  const int jobs = arguments.jobs > 0 ? arguments.jobs : std::max(1, static_cast<int>(ourCores().size()));
  if (arguments.configuration.dry_run) return listRuns(planned, done, folder, jobs);

  catchInterruption();
  std::filesystem::create_directories(output.folder);
  loaded.settings.experiment = withAbsolutePaths(loaded.settings.experiment, plan);
  writeAtomically(output.folder / kConfigurationName, [&](std::ostream& file) { file << toIni(loaded); });
  pointLatestTo(output.folder);
  const Study study{commandOf(arguments), thisMachine(), {}};
  const std::vector<RunRecord> records = Sweep(planned, folder, study, std::move(done)).run(jobs);
  return report(records, planned.size(), output.folder);
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<ExperimentArguments>();
  addConfiguration(app, arguments->configuration)->required();
  addOutputFolder(app, arguments->output)->required();
  addJobs(app, arguments->jobs);
  app.add_flag("--resume", arguments->resume, "keeps runs that are done with the same version, files and parameters");
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb experimentVerb()
{
  return {"experiment", "a sweep of simulated or recorded drives over lidars, N, seeds and parameters",
          schemaOf<ExperimentSettings>(), &addOptions};
}
}  // namespace scanloom
