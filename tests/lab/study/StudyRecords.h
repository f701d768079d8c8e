/** Runs of a sweep that never ran. */
#pragma once
#include "lab/study/internal/RunRecord.h"

namespace scanloom
{
inline RunRecord runWithDrift(double drift, const std::string& lidars = "left", int every_nth = 1,
                              std::uint64_t seed = 1)
{
  RunRecord record;
  record.run.stand = "easy";
  record.run.lidars = lidars;
  record.run.every_nth = every_nth;
  record.run.seed = seed;
  record.version = "1.0";
  record.configuration_hash = "0123";
  record.outcome = "OK";
  record.figures.emplace();
  record.figures->drift = drift;
  record.figures->path = 1000;
  record.figures->drift_percent = drift / 10;
  record.figures->over_distance = {{0, 0}, {500, drift / 2}, {1000, drift}};
  record.costs.emplace();
  record.costs->stage_ms = {{"smoother", 0.5}};
  record.costs->real_time_factor = 4;
  record.costs->peak_memory_mb = 200;
  return record;
}

inline RunRecord failedRun(const std::string& error)
{
  RunRecord record = runWithDrift(0);
  record.outcome = "FAILED";
  record.error = error;
  record.figures.reset();
  record.costs.reset();
  return record;
}
}  // namespace scanloom
