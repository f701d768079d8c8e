/** The runs of a sweep: every combination of its axes, in a fixed order. */
#pragma once
#include "base/config/Configuration.h"
#include "lab/study/internal/ExperimentOptions.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace scanloom
{
/** In place of names: all lidars that the recording has. */
inline constexpr const char* kAllLidars = "all";

struct PlannedRun
{
  std::string stand;                 // name of the simulation's file, or of the recording's file or folder
  std::filesystem::path simulation;  // empty: the drive is a recording
  std::filesystem::path recording;   // empty: the drive is simulated
  std::filesystem::path reference;   // as referenceOf() takes it; empty: what lies beside the drive
  std::string lidars;                // "left,right", or kAllLidars
  int every_nth = 1;
  std::vector<std::pair<std::string, std::string>> settings;  // "section.key", value: fixed ones, then one per axis
  std::uint64_t seed = 0;                                     // 0: a recording has none

  /** `sparse left+right n5 seed 3`; the same for runs that differ in settings only. */
  std::string label() const;
};

struct ExperimentPlan
{
  std::vector<std::filesystem::path> simulations, recordings, references, configurations;
  std::vector<PlannedRun> runs;  // nested loops over stands, lidars, N, axes, seeds: the seed changes fastest
};

/** All sections but [experiment]: their values hold for every run, unless an axis sets the key. */
std::vector<std::string> sectionsForRuns(const Configuration&);

/** Throws ConfigError with the value that is wrong, or the file that does not exist. */
ExperimentPlan planOf(const ExperimentSettings&, const Configuration&);

/** One of them has $env{SCANLOOM_RECORDING}; otherwise slam is given the drive as its argument RECORDING. */
bool findTheDrive(const std::vector<std::filesystem::path>& configurations);

/** With absolute paths, so that a copy of the configuration in another folder means the same files. */
ExperimentOptions withAbsolutePaths(ExperimentOptions, const ExperimentPlan&);
}  // namespace scanloom
