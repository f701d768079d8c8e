/** What is kept of one run of a sweep: a row of results.csv. */
#pragma once
#include "evaluation/Drift.h"
#include "study/ExperimentPlan.h"

#include <nlohmann/json_fwd.hpp>

#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** Nothing where a run did not get so far. */
struct RunFigures
{
  double drift = 0, path = 0, final = 0;        // m, against the total station
  std::size_t samples = 0;                      // of the station, that were compared
  std::optional<double> drift_percent;          // of the path
  std::optional<double> imu_rate_drift, floor;  // m
  double ape = 0;                               // m, root mean square against the true poses
  std::optional<double> rpe, rpe_deg;           // likewise, over 1 m; nothing on a shorter path
  std::vector<ErrorAtDistance> over_distance;   // at the IMU's rate
};

struct RunCosts
{
  std::map<std::string, double> stage_ms;  // means
  double real_time_factor = 0;
  double peak_memory_mb = 0;
  double elapsed = 0;  // s, of slam
};

struct RunRecord
{
  PlannedRun run;
  std::string version, configuration_hash;
  std::string outcome;  // of summary.json, or FAILED
  std::string error;    // why it failed
  std::optional<RunFigures> figures;
  std::optional<RunCosts> costs;

  /** The run did not end in an error. */
  bool finished() const { return error.empty(); }

  /**
   * More than 10 m or 5 % of the path away, or by its own account at the end. At the IMU's rate where that is known:
   * the chords between every 15th scan may be longer, and nobody is lost on them.
   */
  bool lost() const;
};

void to_json(nlohmann::json&, const RunRecord&);
void from_json(const nlohmann::json&, RunRecord&);

/** One line per record, in their order, with a header. Stages are the columns of any run; empty is what a run has not.
 */
void writeCsv(std::ostream&, const std::vector<RunRecord>&);
}  // namespace scanloom
