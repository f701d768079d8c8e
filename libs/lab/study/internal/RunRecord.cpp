#include "lab/study/internal/RunRecord.h"

#include "base/core/csvField.h"
#include "lab/study/internal/RunHash.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace scanloom
{
namespace
{
constexpr double kLostDistance = 10;  // m
constexpr double kLostPercent = 5;

using Json = nlohmann::json;

/** Calls visit(name in JSON and CSV, member, decimals in CSV) in the order of the columns. */
template <typename Figures, typename Visitor>
void forEachFigure(Figures&& f, Visitor&& visit)
{
  visit("drift_m", f.drift, 4);
  visit("drift_percent", f.drift_percent, 3);
  visit("drift_imu_m", f.imu_rate_drift, 4);
  visit("drift_floor_m", f.floor, 4);
  visit("final_m", f.final, 4);
  visit("ape_rmse_m", f.ape, 4);
  visit("rpe_rmse_m", f.rpe, 4);
  visit("rpe_rmse_deg", f.rpe_deg, 4);
  visit("path_m", f.path, 2);
  visit("samples", f.samples, 0);
}

template <typename Costs, typename Visitor>
void forEachCost(Costs&& c, Visitor&& visit)
{
  visit("real_time_factor", c.real_time_factor, 2);
  visit("peak_memory_mb", c.peak_memory_mb, 0);
  visit("elapsed_s", c.elapsed, 1);
}

template <typename Value>
Json jsonOf(const Value& value)
{
  return value;
}
Json jsonOf(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

template <typename Value>
void read(const Json& json, Value& value)
{
  value = json;
}
void read(const Json& json, std::optional<double>& value)
{
  if (!json.is_null()) value = json.get<double>();
}

Json toJson(const RunFigures& f)
{
  Json json;
  forEachFigure(f, [&](const char* name, const auto& value, int) { json[name] = jsonOf(value); });
  Json& over_distance = json["drift_over_distance"] = Json::array();
  for (const auto& [distance, error] : f.over_distance) over_distance.push_back({distance, error});
  return json;
}

RunFigures figuresFrom(const Json& json)
{
  RunFigures f;
  forEachFigure(f, [&](const char* name, auto& value, int) { read(json.at(name), value); });
  for (const Json& row : json.at("drift_over_distance")) f.over_distance.push_back({row.at(0), row.at(1)});
  return f;
}

Json toJson(const RunCosts& c)
{
  Json json;
  json["stage_ms"] = c.stage_ms;
  forEachCost(c, [&](const char* name, double value, int) { json[name] = value; });
  return json;
}

RunCosts costsFrom(const Json& json)
{
  RunCosts c;
  c.stage_ms = json.at("stage_ms").get<decltype(c.stage_ms)>();
  forEachCost(c, [&](const char* name, double& value, int) { value = json.at(name); });
  return c;
}

std::string cell(double value, int decimals) { return fmt::format("{:.{}f}", value, decimals); }
std::string cell(const std::optional<double>& value, int decimals) { return value ? cell(*value, decimals) : ""; }
std::string cell(std::size_t count, int) { return std::to_string(count); }

std::vector<std::string> headerOf(const std::vector<RunRecord>& records, const std::set<std::string>& stages)
{
  std::vector<std::string> names{"version", "configuration", "stand", "lidars", "every_nth"};
  if (!records.empty())
    for (const auto& [name, value] : records.front().run.settings) names.push_back(name);
  const auto add = [&](const char* name, const auto&, int) { names.emplace_back(name); };
  for (const char* name : {"seed", "outcome", "lost"}) names.emplace_back(name);
  forEachFigure(RunFigures{}, add);
  forEachCost(RunCosts{}, add);
  for (const std::string& stage : stages) names.push_back("ms_" + stage);
  for (const char* name : {"poses_ok_percent", "reference"}) names.emplace_back(name);
  names.emplace_back("error");
  return names;
}

std::vector<std::string> rowOf(const RunRecord& record, const std::set<std::string>& stages)
{
  const PlannedRun& run = record.run;
  std::vector<std::string> row{record.version, record.configuration_hash, csvField(run.stand), csvField(run.lidars),
                               std::to_string(run.every_nth)};
  for (const auto& [name, value] : run.settings) row.push_back(csvField(value));
  row.push_back(run.seed > 0 ? std::to_string(run.seed) : "");
  row.push_back(record.outcome);
  row.push_back(record.lost() ? "1" : "0");
  const RunCosts costs = record.costs.value_or(RunCosts{});
  forEachFigure(record.figures.value_or(RunFigures{}), [&](const char*, const auto& value, int decimals)
                { row.push_back(record.figures ? cell(value, decimals) : ""); });
  forEachCost(costs, [&](const char*, double value, int decimals)
              { row.push_back(record.costs ? cell(value, decimals) : ""); });
  for (const std::string& stage : stages)
  {
    const auto found = costs.stage_ms.find(stage);
    row.push_back(found == costs.stage_ms.end() ? "" : cell(found->second, 3));
  }
  row.push_back(cell(record.ok_percent, 1));
  row.push_back(csvField(record.reference));
  row.push_back(csvField(record.error));
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
          {"lost", record.lost()},
          {"reference", record.reference},
          {"poses_ok_percent", jsonOf(record.ok_percent)}};
  for (const RecordedMark& mark : record.marks) json["marks"].push_back({{"after_s", mark.after}, {"text", mark.text}});
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
  record.reference = json.value("reference", "");  // results before 1.1 have none of these two
  record.ok_percent.reset();
  read(json.value("poses_ok_percent", Json()), record.ok_percent);
  record.marks.clear();
  for (const Json& mark : json.value("marks", Json::array()))
    record.marks.push_back({mark.at("after_s"), mark.at("text")});
  record.figures.reset();
  record.costs.reset();
  if (!json.at("figures").is_null()) record.figures = figuresFrom(json.at("figures"));
  if (!json.at("costs").is_null()) record.costs = costsFrom(json.at("costs"));
}

void addStages(const RunRecord& record, std::set<std::string>& stages)
{
  if (!record.costs) return;
  for (const auto& [stage, ms] : record.costs->stage_ms) stages.insert(stage);
}

std::vector<RunRecord> plannedRecords(const ExperimentPlan& plan, const std::string& version)
{
  std::vector<RunRecord> records;
  for (const PlannedRun& run : plan.runs)
  {
    RunRecord record;
    record.run = run;
    record.version = version;
    record.configuration_hash = configurationHash(run, plan, version);
    records.push_back(std::move(record));
  }
  return records;
}

void writeCsv(std::ostream& file, const std::vector<RunRecord>& records)
{
  std::set<std::string> stages;
  for (const RunRecord& record : records) addStages(record, stages);
  fmt::print(file, "{}\n", fmt::join(headerOf(records, stages), ","));
  for (const RunRecord& record : records) fmt::print(file, "{}\n", fmt::join(rowOf(record, stages), ","));
}
}  // namespace scanloom
