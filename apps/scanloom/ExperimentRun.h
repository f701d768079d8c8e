/** One run of a sweep, from its packets to its record. */
#pragma once
#include "Command.h"
#include "study/RunRecord.h"

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

  /** runs/<label>_<first digits of the hash>: other parameters, another folder. */
  std::filesystem::path of(const RunRecord&) const;
};

/** `scanloom slam ...` that the run consists of. */
Command slamCommand(const PlannedRun&, const ExperimentFolder&, const std::filesystem::path& out);

/**
 * Simulates the truth, runs slam in a process of its own, evaluates, and writes record.json, unless it was interrupted.
 * What goes wrong is in the record; std::runtime_error is thrown only if that cannot be written.
 */
RunRecord execute(RunRecord planned, const ExperimentFolder&);

/** What the latest execution with the same hash left; nothing if there was none, or if it was interrupted. */
std::optional<RunRecord> recordOf(const RunRecord& planned, const ExperimentFolder&);

void removeRecord(const RunRecord& planned, const ExperimentFolder&);
}  // namespace scanloom
