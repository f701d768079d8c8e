#include "Sweep.h"

#include "DriveQueue.h"
#include "DriveRecording.h"
#include "Interruption.h"
#include "Progress.h"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
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

/** Drives that have packets, or an error instead. Each is one thread's at a time. */
class DriveFolders
{
 public:
  DriveFolders(std::vector<PlannedDrive> drives, const ExperimentFolder& folder)
    : drives_(std::move(drives)), keep_packets_(folder.keep_packets)
  {
    for (const PlannedDrive& drive : drives_) folders_.push_back({folder.of(drive), ""});
  }

  const DriveFolder& operator[](std::size_t drive) const { return folders_[drive]; }
  void simulate(std::size_t i) { folders_[i].error = simulateDrive(drives_[i], folders_[i].path); }
  void release(std::size_t i) const
  {
    if (drives_[i].simulated() && !keep_packets_) removePackets(folders_[i].path);
  }
  void releaseAll() const
  {
    for (std::size_t i = 0; i < drives_.size(); ++i) release(i);
  }

 private:
  std::vector<PlannedDrive> drives_;
  std::vector<DriveFolder> folders_;
  bool keep_packets_;
};

void work(Results& results, DriveQueue& queue, DriveFolders& drives)
{
  for (auto work = queue.next(); work && !interrupted(); work = queue.next())
  {
    if (!work->run)
    {
      drives.simulate(work->drive);
      queue.simulated(work->drive);
      continue;
    }
    RunRecord record = execute(results.planned()[*work->run], results.folder(), drives[work->drive]);
    if (interrupted()) return;  // half a run is none
    results.add(*work->run, std::move(record));
    if (queue.finishedRun(work->drive)) drives.release(work->drive);
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

std::vector<PlannedDrive> drivesAhead(std::vector<PlannedDrive> drives,
                                      const std::vector<std::optional<RunRecord>>& done)
{
  for (PlannedDrive& drive : drives)
    drive.runs.erase(
        std::remove_if(drive.runs.begin(), drive.runs.end(), [&](std::size_t run) { return done[run].has_value(); }),
        drive.runs.end());
  drives.erase(
      std::remove_if(drives.begin(), drives.end(), [](const PlannedDrive& drive) { return drive.runs.empty(); }),
      drives.end());
  return drives;
}

std::vector<RunRecord> runOnCores(Sweep sweep, int jobs)
{
  const std::vector<PlannedDrive> ahead = drivesAhead(std::move(sweep.drives), sweep.done);
  DriveQueue queue(ahead);
  DriveFolders drives(ahead, sweep.folder);
  Results results(std::move(sweep));
  const std::vector<int> cores = ourCores();
  std::vector<std::thread> threads;
  for (int job = 0; job < jobs; ++job)
    threads.emplace_back(
        [&, job]
        {
          keepToShare(job, jobs, cores);
          work(results, queue, drives);
        });
  for (std::thread& thread : threads) thread.join();
  if (interrupted()) drives.releaseAll();
  return results.close();
}

std::vector<RunRecord> runDrive(const PlannedDrive& drive, const std::vector<RunRecord>& planned,
                                const ExperimentFolder& folder)
{
  DriveFolders drives({drive}, folder);
  if (drive.simulated()) drives.simulate(0);
  std::vector<RunRecord> records;
  for (const std::size_t run : drive.runs)
    if (!interrupted()) records.push_back(execute(planned[run], folder, drives[0]));
  drives.release(0);
  return records;
}

std::vector<RunRecord> runOnSlurm(Sweep sweep, const Command& one_drive, int jobs)
{
  std::vector<std::size_t> numbers;
  std::vector<std::pair<std::size_t, std::size_t>> runs;  // and the numbers of their jobs
  for (std::size_t i = 0; i < sweep.drives.size(); ++i)
  {
    const auto ahead = drivesAhead({sweep.drives[i]}, sweep.done);
    if (ahead.empty()) continue;
    numbers.push_back(i + 1);
    for (const std::size_t run : ahead.front().runs) runs.emplace_back(run, numbers.back());
  }
  Results results(std::move(sweep));
  if (numbers.empty()) return results.close();

  // An old record would pass for that of a job that never ran.
  for (const auto& [run, number] : runs) removeRecord(results.planned()[run], results.folder());
  const auto logs = std::filesystem::absolute(results.folder().root) / "slurm";
  std::filesystem::create_directories(logs);
  const std::string limit = jobs > 0 ? fmt::format("%{}", jobs) : "";
  const Command array{
      {"sbatch", "--wait", "--job-name=scanloom", fmt::format("--array={}{}", fmt::join(numbers, ","), limit),
       fmt::format("--output={}/%a.txt", logs.string()),
       fmt::format("--wrap={} --only $SLURM_ARRAY_TASK_ID", toText(one_drive))},
      {}};
  runCommand(array, logs / "sbatch.txt");  // its status is that of the worst run, which records tell better
  if (interrupted()) return results.close();
  for (const auto& [run, number] : runs)
    results.add(run, leftBehind(results.planned()[run], results.folder(), logs / fmt::format("{}.txt", number)));
  return results.close();
}
}  // namespace scanloom
