/** One run of a sweep: slam on the packets of a drive, evaluation, and a record of both. */
#pragma once
#include "lab/study/PlannedDrive.h"
#include "lab/study/internal/Command.h"
#include "lab/study/internal/RunRecord.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace scanloom
{
struct ExperimentFolder
{
  std::filesystem::path root;
  std::vector<std::filesystem::path> configurations;  // of slam
  bool keep_maps = false;
  bool keep_packets = false;

  /** runs/<label>_<first digits of the hash>: other parameters, another folder. */
  std::filesystem::path of(const RunRecord&) const;

  /** drives/<label>_<first digits of the hash>, or the recording itself. */
  std::filesystem::path of(const PlannedDrive&) const;
};

struct DriveFolder
{
  std::filesystem::path path;
  std::string error;  // why it has no packets; empty: it has
};

/** The `scanloom slam ...` of a run. */
Command slamCommand(const PlannedRun&, const ExperimentFolder&, const std::filesystem::path& drive,
                    const std::filesystem::path& out);

/**
 * Runs slam in a process of its own, evaluates its trajectories, and writes record.json, unless it was interrupted.
 * A failure is part of the record. Throws std::runtime_error if the record cannot be written.
 */
RunRecord execute(RunRecord planned, const ExperimentFolder&, const DriveFolder&);

/** The record that an earlier execution with the same hash wrote; none if there is no such record. */
std::optional<RunRecord> recordOf(const RunRecord& planned, const ExperimentFolder&);

/** In the order of the plan; none: not run yet, or failed. */
using FinishedRuns = std::vector<std::optional<RunRecord>>;
FinishedRuns finishedBefore(const std::vector<RunRecord>& planned, const ExperimentFolder&);

void removeRecord(const RunRecord& planned, const ExperimentFolder&);
}  // namespace scanloom
