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
 * Simulates the truth, runs slam in a process of its own, evaluates, and writes record.json. What goes wrong is in the
 * record: it does not throw.
 */
RunRecord execute(RunRecord planned, const ExperimentFolder&);

/** Of an earlier execution with the same hash that did not fail. */
std::optional<RunRecord> finishedBefore(const RunRecord& planned, const ExperimentFolder&);
}  // namespace scanloom
