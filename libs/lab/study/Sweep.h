/** The runs of an experiment, on the cores of this machine or of a cluster. */
#pragma once
#include "lab/study/internal/ExperimentRun.h"
#include "lab/study/internal/Study.h"

#include <functional>
#include <optional>
#include <vector>

namespace scanloom
{
struct Sweep
{
  std::vector<RunRecord> planned;
  FinishedRuns finished;             // these are not run again
  std::vector<PlannedDrive> drives;  // of all planned runs
  ExperimentFolder folder;
  Study study;  // command and machine; the records are filled in here
};

/** Called after each run, by one thread at a time, with the number of runs that are finished. */
using OnRun = std::function<void(const RunRecord&, std::size_t finished)>;

/** Numbers of the cores that the program may use. */
std::vector<int> ourCores();

/** The drives of the runs that are not finished, each with these runs only. */
std::vector<PlannedDrive> remaining(std::vector<PlannedDrive>, const FinishedRuns&);

/**
 * `jobs` threads simulate drives and run slam on them. The results are saved after every run.
 * @return the records of all finished runs, in the order of the plan.
 */
std::vector<RunRecord> runOnCores(Sweep, int jobs, const OnRun&);

/** One drive and its runs, one after the other; each run leaves its record.json. */
std::vector<RunRecord> runDrive(const PlannedDrive&, const std::vector<RunRecord>& planned, const ExperimentFolder&);

/**
 * One job array, a job per drive, and waits for its end. All nodes must see the folder.
 * @param one_drive the command of a job, but for `--only N`: it does those runs of drive N that have no record.json.
 * @param jobs how many jobs run at the same time at most; 0: as many as Slurm permits.
 * Throws std::runtime_error if sbatch cannot be started.
 */
std::vector<RunRecord> runOnSlurm(Sweep, const Command& one_drive, int jobs, const OnRun&);

/** What is still to be done, in s: from the mean time of the finished runs, or assumed shares of the drives' lengths.
 */
double estimatedSeconds(const Sweep&, int jobs);
}  // namespace scanloom
