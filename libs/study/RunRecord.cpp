#include "study/RunRecord.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <nlohmann/json.hpp>

#include <set>

namespace scanloom
{
namespace
{
constexpr double kLostDistance = 10;  // m
constexpr double kLostPercent = 5;

using Json = nlohmann::json;

Json orNull(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

std::optional<double> optionalAt(const Json& json, const char* key)
{
  const Json& value = json.at(key);
  if (value.is_null()) return std::nullopt;
  return value.get<double>();
}

Json toJson(const RunFigures& f)
{
  Json over_distance = Json::array();
  for (const auto& [distance, error] : f.over_distance) over_distance.push_back({distance, error});
  return {{"drift_m", f.drift},
          {"path_m", f.path},
          {"final_m", f.final},
          {"samples", f.samples},
          {"drift_percent", orNull(f.drift_percent)},
          {"drift_imu_m", orNull(f.imu_rate_drift)},
          {"drift_floor_m", orNull(f.floor)},
          {"ape_rmse_m", f.ape},
          {"rpe_rmse_m", orNull(f.rpe)},
          {"rpe_rmse_deg", orNull(f.rpe_deg)},
          {"drift_over_distance", over_distance}};
}

RunFigures figuresFrom(const Json& json)
{
  RunFigures f;
  f.drift = json.at("drift_m");
  f.path = json.at("path_m");
  f.final = json.at("final_m");
  f.samples = json.at("samples");
  f.drift_percent = optionalAt(json, "drift_percent");
  f.imu_rate_drift = optionalAt(json, "drift_imu_m");
  f.floor = optionalAt(json, "drift_floor_m");
  f.ape = json.at("ape_rmse_m");
  f.rpe = optionalAt(json, "rpe_rmse_m");
  f.rpe_deg = optionalAt(json, "rpe_rmse_deg");
  for (const Json& row : json.at("drift_over_distance")) f.over_distance.push_back({row.at(0), row.at(1)});
  return f;
}

Json toJson(const RunCosts& c)
{
  return {{"stage_ms", c.stage_ms},
          {"real_time_factor", c.real_time_factor},
          {"peak_memory_mb", c.peak_memory_mb},
          {"elapsed_s", c.elapsed}};
}

RunCosts costsFrom(const Json& json)
{
  return {json.at("stage_ms"), json.at("real_time_factor"), json.at("peak_memory_mb"), json.at("elapsed_s")};
}

/** RFC 4180. */
std::string cell(const std::string& text)
{
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string cell(const std::optional<double>& value, int decimals)
{
  return value ? fmt::format("{:.{}f}", *value, decimals) : "";
}

std::set<std::string> stagesOf(const std::vector<RunRecord>& records)
{
  std::set<std::string> stages;
  for (const RunRecord& record : records)
    if (record.costs)
      for (const auto& [stage, ms] : record.costs->stage_ms) stages.insert(stage);
  return stages;
}

std::vector<std::string> headerOf(const std::vector<RunRecord>& records, const std::set<std::string>& stages)
{
  std::vector<std::string> names{"version", "configuration", "stand", "lidars", "every_nth"};
  if (!records.empty())
    for (const auto& [name, value] : records.front().run.settings) names.push_back(name);
  for (const char* name :
       {"seed", "outcome", "lost", "drift_m", "drift_percent", "drift_imu_m", "drift_floor_m", "final_m", "ape_rmse_m",
        "rpe_rmse_m", "rpe_rmse_deg", "path_m", "samples", "real_time_factor", "peak_memory_mb", "elapsed_s"})
    names.emplace_back(name);
  for (const std::string& stage : stages) names.push_back("ms_" + stage);
  names.emplace_back("error");
  return names;
}

std::vector<std::string> figureCells(const std::optional<RunFigures>& figures)
{
  if (!figures) return std::vector<std::string>(10);
  const RunFigures& f = *figures;
  return {cell(f.drift, 4),         cell(f.drift_percent, 3), cell(f.imu_rate_drift, 4),
          cell(f.floor, 4),         cell(f.final, 4),         cell(f.ape, 4),
          cell(f.rpe, 4),           cell(f.rpe_deg, 4),       cell(f.path, 2),
          std::to_string(f.samples)};
}

std::vector<std::string> costCells(const std::optional<RunCosts>& costs, const std::set<std::string>& stages)
{
  if (!costs) return std::vector<std::string>(3 + stages.size());
  std::vector<std::string> cells{cell(costs->real_time_factor, 2), cell(costs->peak_memory_mb, 0),
                                 cell(costs->elapsed, 1)};
  for (const std::string& stage : stages)
  {
    const auto found = costs->stage_ms.find(stage);
    cells.push_back(found == costs->stage_ms.end() ? "" : cell(found->second, 3));
  }
  return cells;
}

std::vector<std::string> rowOf(const RunRecord& record, const std::set<std::string>& stages)
{
  const PlannedRun& run = record.run;
  std::vector<std::string> row{record.version, record.configuration_hash, cell(run.stand), cell(run.lidars),
                               std::to_string(run.every_nth)};
  for (const auto& [name, value] : run.settings) row.push_back(cell(value));
  row.push_back(run.seed > 0 ? std::to_string(run.seed) : "");
  row.push_back(record.outcome);
  row.push_back(record.lost() ? "1" : "0");
  for (std::string& text : figureCells(record.figures)) row.push_back(std::move(text));
  for (std::string& text : costCells(record.costs, stages)) row.push_back(std::move(text));
  row.push_back(cell(record.error));
  return row;
}
}  // namespace

bool RunRecord::lost() const
{
  if (outcome == "LOST") return true;
  if (!figures) return false;
  const double drift = figures->imu_rate_drift.value_or(figures->drift);
  return drift > kLostDistance || (figures->path > 0 && 100 * drift / figures->path > kLostPercent);
}

void to_json(Json& json, const RunRecord& record)
{
  const PlannedRun& run = record.run;
  json = {{"stand", run.stand},
          {"simulation", run.simulation.string()},
          {"recording", run.recording.string()},
          {"lidars", run.lidars},
          {"every_nth", run.every_nth},
          {"settings", run.settings},
          {"seed", run.seed},
          {"version", record.version},
          {"configuration_hash", record.configuration_hash},
          {"outcome", record.outcome},
          {"error", record.error},
          {"lost", record.lost()}};
  json["figures"] = record.figures ? toJson(*record.figures) : Json();
  json["costs"] = record.costs ? toJson(*record.costs) : Json();
}

void from_json(const Json& json, RunRecord& record)
{
  PlannedRun& run = record.run;
  run.stand = json.at("stand");
  run.simulation = json.at("simulation").get<std::string>();
  run.recording = json.at("recording").get<std::string>();
  run.lidars = json.at("lidars");
  run.every_nth = json.at("every_nth");
  run.settings = json.at("settings").get<decltype(run.settings)>();
  run.seed = json.at("seed");
  record.version = json.at("version");
  record.configuration_hash = json.at("configuration_hash");
  record.outcome = json.at("outcome");
  record.error = json.at("error");
  record.figures.reset();
  record.costs.reset();
  if (!json.at("figures").is_null()) record.figures = figuresFrom(json.at("figures"));
  if (!json.at("costs").is_null()) record.costs = costsFrom(json.at("costs"));
}

void writeCsv(std::ostream& file, const std::vector<RunRecord>& records)
{
  const std::set<std::string> stages = stagesOf(records);
  fmt::print(file, "{}\n", fmt::join(headerOf(records, stages), ","));
  for (const RunRecord& record : records) fmt::print(file, "{}\n", fmt::join(rowOf(record, stages), ","));
}
}  // namespace scanloom
