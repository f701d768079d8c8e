#include "Sweep.h"

#include "Interruption.h"
#include "Progress.h"

#include <fmt/format.h>
#include <sched.h>

#include <atomic>
#include <mutex>
#include <thread>

namespace scanloom
{
namespace
{
/** Each job has cores of its own, which its processes inherit: their times stay comparable. */
void keepToShare(int job, int jobs, const std::vector<int>& cores)
{
  cpu_set_t set;
  CPU_ZERO(&set);
  for (std::size_t i = static_cast<std::size_t>(job); i < cores.size(); i += static_cast<std::size_t>(jobs))
    CPU_SET(cores[i], &set);
  if (CPU_COUNT(&set) > 0) sched_setaffinity(0, sizeof set, &set);
}

/** What is done, kept on disk. Threads may share it. */
class Results
{
 public:
  explicit Results(Sweep sweep)
    : planned_(std::move(sweep.planned)),
      folder_(std::move(sweep.folder)),
      done_(std::move(sweep.done)),
      study_(std::move(sweep.study)),
      progress_("experiment", planned_.size(), "runs")
  {
  }

  const std::vector<RunRecord>& planned() const { return planned_; }
  const ExperimentFolder& folder() const { return folder_; }

  bool has(std::size_t i) const
  {
    const std::lock_guard lock(mutex_);
    return done_[i].has_value();
  }

  void add(std::size_t i, RunRecord record)
  {
    const std::lock_guard lock(mutex_);
    if (!record.finished()) fmt::print(stderr, "failed: {}: {}\n", folder_.of(record).string(), record.error);
    done_[i] = std::move(record);
    save();
    progress_.update(study_.records.size());
  }

  std::vector<RunRecord> close()
  {
    const std::lock_guard lock(mutex_);
    save();
    return study_.records;
  }

 private:
  void save()
  {
    study_.records.clear();
    for (const auto& record : done_)
      if (record) study_.records.push_back(*record);
    writeStudy(folder_.root, study_);
  }

  const std::vector<RunRecord> planned_;
  const ExperimentFolder folder_;
  mutable std::mutex mutex_;  // for what follows
  std::vector<std::optional<RunRecord>> done_;
  Study study_;
  Progress progress_;
};

void work(Results& results, std::atomic<std::size_t>& next)
{
  for (std::size_t i = next++; i < results.planned().size() && !interrupted(); i = next++)
  {
    if (results.has(i)) continue;
    RunRecord record = execute(results.planned()[i], results.folder());
    if (interrupted()) return;  // half a run is none
    results.add(i, std::move(record));
  }
}

RunRecord leftBehind(const RunRecord& planned, const ExperimentFolder& folder, const std::filesystem::path& log)
{
  if (auto record = recordOf(planned, folder)) return *record;
  RunRecord record = planned;
  record.outcome = "FAILED";
  record.error = fmt::format("its job left no record: see {}", log.string());
  return record;
}
}  // namespace

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

std::vector<RunRecord> runOnCores(Sweep sweep, int jobs)
{
  Results results(std::move(sweep));
  const std::vector<int> cores = ourCores();
  std::atomic<std::size_t> next = 0;
  std::vector<std::thread> threads;
  for (int job = 0; job < jobs; ++job)
    threads.emplace_back(
        [&, job]
        {
          keepToShare(job, jobs, cores);
          work(results, next);
        });
  for (std::thread& thread : threads) thread.join();
  return results.close();
}

std::vector<RunRecord> runOnSlurm(Sweep sweep, const Command& one_run, int jobs)
{
  Results results(std::move(sweep));
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < results.planned().size(); ++i)
    if (!results.has(i))
    {
      removeRecord(results.planned()[i],
                   results.folder());  // or an old one would pass for that of a job that never ran
      numbers.push_back(i + 1);
    }
  if (numbers.empty()) return results.close();

  const auto logs = std::filesystem::absolute(results.folder().root) / "slurm";
  std::filesystem::create_directories(logs);
  const std::string limit = jobs > 0 ? fmt::format("%{}", jobs) : "";
  const Command array{
      {"sbatch", "--wait", "--job-name=scanloom", fmt::format("--array={}{}", fmt::join(numbers, ","), limit),
       fmt::format("--output={}/%a.txt", logs.string()),
       fmt::format("--wrap={} --only $SLURM_ARRAY_TASK_ID", toText(one_run))},
      {}};
  runCommand(array, logs / "sbatch.txt");  // its status is that of the worst run, which records tell better
  if (interrupted()) return results.close();
  for (const std::size_t number : numbers)
    results.add(number - 1,
                leftBehind(results.planned()[number - 1], results.folder(), logs / fmt::format("{}.txt", number)));
  return results.close();
}
}  // namespace scanloom
