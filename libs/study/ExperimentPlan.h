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
  std::string stand;                 // name of the simulation's file or the recording's folder
  std::filesystem::path simulation;  // empty: a recording
  std::filesystem::path recording;   // empty: a simulation
  std::string lidars;                // "left,right"
  int every_nth = 1;
  std::vector<std::pair<std::string, std::string>> settings;  // "section.key" and its value: held fixed, then per axis
  std::uint64_t seed = 0;                                     // 0: a recording, nothing is drawn

  /** `sparse left+right n5 seed 3`; runs that differ in settings alone share it. */
  std::string label() const;
};

struct ExperimentPlan
{
  std::vector<std::filesystem::path> simulations, recordings, configurations;
  std::vector<PlannedRun> runs;  // stands first, then lidars, N, axes, and the seeds as the fastest
};

/** All but [experiment]: what they say holds for every run, unless an axis says otherwise. */
std::vector<std::string> sectionsForRuns(const Configuration&);

/** Throws ConfigError naming the value that is wrong, or the file that is not there. */
ExperimentPlan planOf(const ExperimentSettings&, const Configuration&);

/**
 * 32 hexadecimal digits of everything that a run's result depends on: the program's version, the content of all its
 * files (of a recording their names and sizes) and its place in the plan.
 */
std::string configurationHash(const PlannedRun&, const ExperimentPlan&, const std::string& version);
}  // namespace scanloom
