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
  ExperimentFolder folder;
  Study study;  // what is known of it before the first run
};

/** Numbers of the cores that the program may use. */
std::vector<int> ourCores();

/** `jobs` at once. Results are saved after every run. @return all that is done, in the order of the plan. */
std::vector<RunRecord> runOnCores(Sweep, int jobs);

/**
 * As a job array that sbatch waits for; the folder must be one that all nodes share.
 * @param one_run a command to which `--only N` is added, N from 1 on; it leaves record.json.
 * @param jobs at most at once; 0: as many as Slurm grants.
 * Throws std::runtime_error if sbatch cannot be started.
 */
std::vector<RunRecord> runOnSlurm(Sweep, const Command& one_run, int jobs);
}  // namespace scanloom
