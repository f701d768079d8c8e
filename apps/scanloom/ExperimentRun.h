/** One run of a sweep, from its drive's packets to its record. */
#pragma once
#include "Command.h"
#include "study/PlannedDrive.h"
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
  bool keep_packets = false;

  /** runs/<label>_<first digits of the hash>: other parameters, another folder. */
  std::filesystem::path of(const RunRecord&) const;

  /** drives/<label>_<first digits of the hash>, or the recording itself. */
  std::filesystem::path of(const PlannedDrive&) const;
};

struct DriveFolder
{
  std::filesystem::path path;
  std::string error;  // why it holds no packets; empty: it does
};

/** `scanloom slam ...` that the run consists of. */
Command slamCommand(const PlannedRun&, const ExperimentFolder&, const std::filesystem::path& drive,
                    const std::filesystem::path& out);

/**
 * Runs slam in a process of its own, evaluates, and writes record.json, unless it was interrupted.
 * What goes wrong is in the record; std::runtime_error is thrown only if that cannot be written.
 */
RunRecord execute(RunRecord planned, const ExperimentFolder&, const DriveFolder&);

/** What the latest execution with the same hash left; nothing if there was none, or if it was interrupted. */
std::optional<RunRecord> recordOf(const RunRecord& planned, const ExperimentFolder&);

void removeRecord(const RunRecord& planned, const ExperimentFolder&);
}  // namespace scanloom
