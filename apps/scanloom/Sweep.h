/** The runs of an experiment, on this machine's cores or on those of a cluster. */
#pragma once
#include "ExperimentRun.h"
#include "study/Study.h"

#include <optional>
#include <vector>

namespace scanloom
{
struct Sweep
{
  std::vector<RunRecord> planned;
  std::vector<std::optional<RunRecord>> done;  // in the same order; these are not run again
  std::vector<PlannedDrive> drives;            // of what is planned
  ExperimentFolder folder;
  Study study;  // what is known of it before the first run
};

/** Numbers of the cores that the program may use. */
std::vector<int> ourCores();

/** The same drives with the runs that are not done. */
std::vector<PlannedDrive> drivesAhead(std::vector<PlannedDrive>, const std::vector<std::optional<RunRecord>>& done);

/** `jobs` at once: simulations, and runs on what they made. Results are saved after every run. @return all that is
 * done, in the order of the plan. */
std::vector<RunRecord> runOnCores(Sweep, int jobs);

/** One after the other, each leaves record.json; a simulated drive is made first. */
std::vector<RunRecord> runDrive(const PlannedDrive&, const std::vector<RunRecord>& planned, const ExperimentFolder&);

/**
 * As a job array, a drive with all of its runs in each, that sbatch waits for; the folder must be one that all nodes
 * share.
 * @param one_drive a command to which `--only N` is added, N from 1 on: it does the runs that have no record.json.
 * @param jobs at most at once; 0: as many as Slurm grants.
 * Throws std::runtime_error if sbatch cannot be started.
 */
std::vector<RunRecord> runOnSlurm(Sweep, const Command& one_drive, int jobs);
}  // namespace scanloom
