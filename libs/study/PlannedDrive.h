/** The drives of a sweep: what its runs read. */
#pragma once
#include "study/ExperimentPlan.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace scanloom
{
struct PlannedDrive
{
  std::string stand;
  std::filesystem::path simulation;                           // empty: a recording
  std::filesystem::path recording;                            // empty: a simulation
  std::vector<std::pair<std::string, std::string>> settings;  // of the simulation
  std::uint64_t seed = 0;
  std::string hash;               // 32 hexadecimal digits of the program's version and of all of the above
  std::vector<std::size_t> runs;  // their places in the plan, ascending

  bool simulated() const { return recording.empty(); }

  /** `sparse seed 3`; drives that differ in settings alone share it. */
  std::string label() const;
};

/** A parameter of the simulation; all others are of slam. */
bool changesTheDrive(const std::string& setting);

/** By their first runs. Runs on a recording share nothing that has to be made: each has a drive of its own. */
std::vector<PlannedDrive> drivesOf(const std::vector<PlannedRun>&, const std::string& version);
}  // namespace scanloom
