/** The result of one run of a sweep: a row of results.csv. */
#pragma once
#include "lab/evaluation/Drift.h"
#include "lab/study/ExperimentPlan.h"

#include <nlohmann/json_fwd.hpp>

#include <iosfwd>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace scanloom
{
struct RunFigures
{
  double drift = 0, path = 0, final = 0;        // m, against the reference
  std::size_t samples = 0;                      // number of positions of the reference that were compared
  std::optional<double> drift_percent;          // of the path
  std::optional<double> imu_rate_drift, floor;  // m
  double ape = 0;                               // m, root mean square against the poses, else the station's positions
  std::optional<double> rpe, rpe_deg;           // the same over 1 m; none on a shorter path
  std::vector<ErrorAtDistance> over_distance;   // of the trajectory at the IMU's rate
};

struct RunCosts
{
  std::map<std::string, double> stage_ms;  // mean per stage
  double real_time_factor = 0;
  double peak_memory_mb = 0;
  double elapsed = 0;  // s, wall-clock time of slam
};

/** An event that a person marked while the recording was made. */
struct RecordedMark
{
  double after = 0;  // s after the first scan
  std::string text;
};

struct RunRecord
{
  PlannedRun run;
  std::string version, configuration_hash;
  std::string outcome;                // of summary.json, or FAILED
  std::string error;                  // why it failed; empty: it did not
  std::string reference;              // RunReference::description; empty: it was compared with nothing
  std::optional<RunFigures> figures;  // none: it failed, or there is no reference
  std::optional<RunCosts> costs;      // none: it failed
  std::vector<RecordedMark> marks;    // of the recording
  std::optional<double> ok_percent;   // of the poses, those whose health is OK; none: it failed, or has no poses

  /** It did not fail; it may be lost. */
  bool finished() const { return error.empty(); }

  /**
   * slam ended LOST, or, with a reference, the drift is more than 10 m or 5 % of the path. The drift is that of the
   * trajectory at the IMU's rate if there is one: with every 15th scan the interpolation between scans alone may be
   * wrong by more.
   */
  bool lost() const;
};

/** Adds the names of the record's stages. */
void addStages(const RunRecord&, std::set<std::string>& stages);

/** Records with the run, the version and the hash only. */
std::vector<RunRecord> plannedRecords(const ExperimentPlan&, const std::string& version);

void to_json(nlohmann::json&, const RunRecord&);
void from_json(const nlohmann::json&, RunRecord&);

/** A header and one line per record. There is a column for every stage of any run; a value that a run lacks is empty.
 */
void writeCsv(std::ostream&, const std::vector<RunRecord>&);
}  // namespace scanloom
