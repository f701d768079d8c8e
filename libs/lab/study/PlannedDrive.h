/** The drives of a sweep. Runs that read the same packets share one. */
#pragma once
#include "lab/study/ExperimentPlan.h"

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
  std::filesystem::path simulation;                           // empty: it is a recording
  std::filesystem::path recording;                            // empty: it is simulated
  std::vector<std::pair<std::string, std::string>> settings;  // those of the simulation
  std::uint64_t seed = 0;
  std::string hash;               // 32 hexadecimal digits from the version of the program and all of the above
  std::vector<std::size_t> runs;  // their places in the plan, ascending

  bool simulated() const { return recording.empty(); }

  /** `sparse seed 3`; the same for drives that differ in settings only. */
  std::string label() const;
};

/** It is a parameter of the simulation ([simulated_...]); all others are of slam. */
bool changesTheDrive(const std::string& setting);

/** Those that do not change the drive. */
std::vector<std::pair<std::string, std::string>> settingsOfSlam(const PlannedRun&);

/** In the order of their first runs. Each run on a recording has a drive of its own: there is nothing to simulate. */
std::vector<PlannedDrive> drivesOf(const std::vector<PlannedRun>&, const std::string& version);
}  // namespace scanloom
