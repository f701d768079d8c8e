#include "lab/study/Sweep.h"

#include "base/config/Configuration.h"
#include "base/core/Interruption.h"
#include "lab/simulation/RecordingOptions.h"
#include "lab/study/DriveRecording.h"
#include "lab/study/internal/DriveQueue.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sched.h>

#include <algorithm>
#include <mutex>
#include <thread>

namespace scanloom
{
namespace
{
/** Each job has cores of its own, and so have the processes that it starts: their times are comparable. */
void useOwnCores(int job, int jobs, const std::vector<int>& cores)
{
  cpu_set_t set;
  CPU_ZERO(&set);
  for (std::size_t i = static_cast<std::size_t>(job); i < cores.size(); i += static_cast<std::size_t>(jobs))
    CPU_SET(cores[i], &set);
  if (CPU_COUNT(&set) > 0) sched_setaffinity(0, sizeof set, &set);
}

/** The finished runs, in memory and on disk. Threads share it. */
class Results
{
 public:
  Results(Sweep sweep, const OnRun& on_run) : sweep_(std::move(sweep)), on_run_(on_run) {}

  const RunRecord& planned(std::size_t run) const { return sweep_.planned[run]; }
  const ExperimentFolder& folder() const { return sweep_.folder; }

  void add(std::size_t run, RunRecord record)
  {
    const std::lock_guard lock(mutex_);
    sweep_.finished[run] = std::move(record);
    save();
    on_run_(*sweep_.finished[run], sweep_.study.records.size());
  }

  std::vector<RunRecord> close()
  {
    const std::lock_guard lock(mutex_);
    save();
    return sweep_.study.records;
  }

 private:
  void save()
  {
    Study& study = sweep_.study;
    study.records.clear();
    for (const auto& record : sweep_.finished)
      if (record) study.records.push_back(*record);
    writeStudy(sweep_.folder.root, study);
  }

  std::mutex mutex_;  // for finished and study
  Sweep sweep_;
  const OnRun& on_run_;
};

/** The folders that the runs read. Each drive is used by one thread until it is simulated, then only read. */
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
  void cleanUp(std::size_t i) const
  {
    if (drives_[i].simulated() && !keep_packets_) removePackets(folders_[i].path);
  }
  void cleanUpAll() const
  {
    for (std::size_t i = 0; i < drives_.size(); ++i) cleanUp(i);
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
    RunRecord record = execute(results.planned(*work->run), results.folder(), drives[work->drive]);
    if (interrupted()) return;  // a run that did not come to its end is not recorded
    results.add(*work->run, std::move(record));
    if (queue.finishedRun(work->drive)) drives.cleanUp(work->drive);
  }
}

/** The record that the job wrote, or one that says that it wrote none. */
RunRecord recordOfJob(const RunRecord& planned, const ExperimentFolder& folder, const std::filesystem::path& log)
{
  if (auto record = recordOf(planned, folder)) return *record;
  RunRecord record = planned;
  record.outcome = "FAILED";
  record.error = fmt::format("its job left no record: see {}", log.string());
  return record;
}

double lengthOf(const PlannedDrive& drive)
{
  constexpr double kAssumed = 60;  // s, of a recording
  if (!drive.simulated()) return kAssumed;
  Configuration configuration = Configuration::fromFiles({drive.simulation});
  for (const auto& [name, value] : drive.settings) configuration.set(name + '=' + value);
  return readSettings<SimulationSettings>(configuration).drive.duration;
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

std::vector<PlannedDrive> remaining(std::vector<PlannedDrive> drives, const FinishedRuns& finished)
{
  for (PlannedDrive& drive : drives)
    drive.runs.erase(std::remove_if(drive.runs.begin(), drive.runs.end(),
                                    [&](std::size_t run) { return finished[run].has_value(); }),
                     drive.runs.end());
  drives.erase(
      std::remove_if(drives.begin(), drives.end(), [](const PlannedDrive& drive) { return drive.runs.empty(); }),
      drives.end());
  return drives;
}

std::vector<RunRecord> runOnCores(Sweep sweep, int jobs, const OnRun& on_run)
{
  const std::vector<PlannedDrive> left = remaining(std::move(sweep.drives), sweep.finished);
  DriveQueue queue(left);
  DriveFolders drives(left, sweep.folder);
  Results results(std::move(sweep), on_run);
  const std::vector<int> cores = ourCores();
  std::vector<std::thread> threads;
  for (int job = 0; job < jobs; ++job)
    threads.emplace_back(
        [&, job]
        {
          useOwnCores(job, jobs, cores);
          work(results, queue, drives);
        });
  for (std::thread& thread : threads) thread.join();
  if (interrupted()) drives.cleanUpAll();
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
  drives.cleanUp(0);
  return records;
}

namespace
{
/** As Slurm wants a '%' of a path, because it replaces patterns. */
std::string withDoubledPercents(const std::string& path)
{
  std::string doubled;
  for (const char c : path) doubled += c == '%' ? std::string("%%") : std::string(1, c);
  return doubled;
}
}  // namespace

std::vector<RunRecord> runOnSlurm(Sweep sweep, const Command& one_drive, int jobs, const OnRun& on_run)
{
  std::vector<std::size_t> numbers;
  std::vector<std::pair<std::size_t, std::size_t>> runs;  // and the numbers of their jobs
  for (std::size_t i = 0; i < sweep.drives.size(); ++i)
  {
    const auto left = remaining({sweep.drives[i]}, sweep.finished);
    if (left.empty()) continue;
    numbers.push_back(i + 1);
    for (const std::size_t run : left.front().runs) runs.emplace_back(run, numbers.back());
  }
  Results results(std::move(sweep), on_run);
  if (numbers.empty()) return results.close();

  // Otherwise an old record would be taken for that of a job that never ran.
  for (const auto& [run, number] : runs) removeRecord(results.planned(run), results.folder());
  const auto logs = std::filesystem::absolute(results.folder().root) / "slurm";
  std::filesystem::create_directories(logs);
  const std::string limit = jobs > 0 ? fmt::format("%{}", jobs) : "";
  const Command array{
      {"sbatch", "--wait", "--job-name=scanloom", fmt::format("--array={}{}", fmt::join(numbers, ","), limit),
       fmt::format("--output={}/%a.txt", withDoubledPercents(logs.string())),
       fmt::format("--wrap={} --only $SLURM_ARRAY_TASK_ID", toText(one_drive))},
      {}};
  runCommand(array, logs / "sbatch.txt");  // its status is that of the worst run: the records say more
  if (interrupted()) return results.close();
  for (const auto& [run, number] : runs)
    results.add(run, recordOfJob(results.planned(run), results.folder(), logs / fmt::format("{}.txt", number)));
  return results.close();
}

double estimatedSeconds(const Sweep& sweep, int jobs)
{
  constexpr double kSimulation = 0.4, kEveryScan = 0.1;  // of the drive: two lidars of 32 beams, 512x10, on one core
  double elapsed = 0, count = 0;
  for (const auto& record : sweep.finished)
    if (record && record->costs)
    {
      elapsed += record->costs->elapsed;
      ++count;
    }
  double left = 0;
  for (const PlannedDrive& drive : remaining(sweep.drives, sweep.finished))
  {
    const double length = lengthOf(drive);
    if (drive.simulated()) left += kSimulation * length;
    for (const std::size_t run : drive.runs)
      left += count > 0 ? elapsed / count : kEveryScan * length / sweep.planned[run].run.every_nth;
  }
  return left / jobs;
}
}  // namespace scanloom
