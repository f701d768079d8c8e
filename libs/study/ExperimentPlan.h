/** The runs of a sweep: every combination of its axes, in a fixed order. */
#pragma once
#include "config/Configuration.h"
#include "study/ExperimentOptions.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace scanloom
{
struct PlannedRun
{
  std::string stand;                 // name of the simulation's file or of the recording's folder
  std::filesystem::path simulation;  // empty: the drive is a recording
  std::filesystem::path recording;   // empty: the drive is simulated
  std::string lidars;                // "left,right"
  int every_nth = 1;
  std::vector<std::pair<std::string, std::string>> settings;  // "section.key", value: fixed ones, then one per axis
  std::uint64_t seed = 0;                                     // 0: a recording has none

  /** `sparse left+right n5 seed 3`; the same for runs that differ in settings only. */
  std::string label() const;
};

struct ExperimentPlan
{
  std::vector<std::filesystem::path> simulations, recordings, configurations;
  std::vector<PlannedRun> runs;  // nested loops over stands, lidars, N, axes, seeds: the seed changes fastest
};

/** All sections but [experiment]: their values hold for every run, unless an axis sets the key. */
std::vector<std::string> sectionsForRuns(const Configuration&);

/** Throws ConfigError with the value that is wrong, or the file that does not exist. */
ExperimentPlan planOf(const ExperimentSettings&, const Configuration&);

/** The runs set only names that some verb knows. Throws ConfigError otherwise: every run would fail. */
void refuseUnknownSettings(const ExperimentPlan&, const Schema& known);

/** With absolute paths, so that a copy of the configuration in another folder means the same files. */
ExperimentOptions withAbsolutePaths(ExperimentOptions, const ExperimentPlan&);

/**
 * 32 hexadecimal digits from everything that the result of a run depends on: version of the program, label, settings,
 * content of the configurations and of the simulation's file; of a recording the names and sizes of its files.
 */
std::string configurationHash(const PlannedRun&, const ExperimentPlan&, const std::string& version);
}  // namespace scanloom
