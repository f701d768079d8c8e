/** summary.json: what a run did, how long it took and how it ended. */
#pragma once
#include "base/core/Finding.h"
#include "base/core/StageTimes.h"
#include "estimation/imu/GyroAgreement.h"
#include "input/rig/SensorInput.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct MarkedEvent
{
  EventMark mark;
  double after = 0;  // s after the start of the first scan
};

/** All that summary.json says of a run, hence more than a dozen members. */
struct RunSummary
{
  std::string command;                          // the line that repeats the run
  std::string outcome;                          // see SlamRunResult
  std::string error;                            // what ended the run, or which maps are missing and why; empty: nothing
  std::map<std::string, std::string> versions;  // program or library -> version
  std::uint64_t seed = 0;                       // 0: no random numbers
  std::map<std::string, std::uint64_t> counts;  // "scans", "keyframes", "packets.left", ...
  std::map<std::string, StageTime> stages;
  Findings lidars;                   // whether their poses fit what they see (LidarCheck)
  std::optional<GyroAgreement> imu;  // compared with the rotations that the lidars saw in the last minute
  std::vector<MarkedEvent> marks;    // by a person, in the order of time
  double recorded = 0;               // s of recording that were processed
  double elapsed = 0;                // s of wall-clock time
  double waited = 0;                 // s of `elapsed`, live: waiting for the sensors
  double path_length = 0;            // m
  std::uint64_t peak_memory = 0;     // bytes

  /** Above 1: faster than real time. 0 if nothing was measured. */
  double realTimeFactor() const { return elapsed > waited ? recorded / (elapsed - waited) : 0; }
};

/** The program's largest resident set so far, in bytes. */
std::uint64_t peakMemory();

void to_json(nlohmann::json&, const StageTime&);
void to_json(nlohmann::json&, const GyroAgreement&);
void to_json(nlohmann::json&, const MarkedEvent&);
void to_json(nlohmann::json&, const RunSummary&);

void writeSummary(const std::filesystem::path&, const RunSummary&);
}  // namespace scanloom
