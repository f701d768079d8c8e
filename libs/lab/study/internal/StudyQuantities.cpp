#include "lab/study/internal/StudyQuantities.h"

namespace scanloom
{
namespace
{
template <typename Value>
Quantity figure(const std::string& name, Value RunFigures::*value)
{
  return {name,
          [value](const RunRecord& record) -> std::optional<double>
          {
            if (!record.figures) return std::nullopt;
            return (*record.figures).*value;
          }};
}

Quantity cost(const std::string& name, double RunCosts::*value)
{
  return {name,
          [value](const RunRecord& record) -> std::optional<double>
          {
            if (!record.costs) return std::nullopt;
            return (*record.costs).*value;
          },
          LostRuns::LikeOthers};
}

Quantity health()
{
  return {"poses that are OK [%]", [](const RunRecord& record) { return record.ok_percent; }, LostRuns::LikeOthers};
}
}  // namespace

Quantity millisecondsOf(const std::string& stage)
{
  return {stage,
          [stage](const RunRecord& record) -> std::optional<double>
          {
            if (!record.costs || record.costs->stage_ms.count(stage) == 0) return std::nullopt;
            return record.costs->stage_ms.at(stage);
          },
          LostRuns::LikeOthers};
}

const Quantity& drift()
{
  static const Quantity quantity = figure("drift [m]", &RunFigures::drift);
  return quantity;
}

std::vector<Quantity> drawnQuantities()
{
  return {drift(), figure("drift at the IMU's rate [m]", &RunFigures::imu_rate_drift), health(),
          cost("real-time factor", &RunCosts::real_time_factor), cost("peak memory [MB]", &RunCosts::peak_memory_mb)};
}

std::set<std::string> stagesOf(const std::vector<StudyCell>& cells)
{
  std::set<std::string> stages;
  for (const StudyCell& cell : cells)
    for (const RunRecord* record : cell.records) addStages(*record, stages);
  return stages;
}

std::vector<Quantity> errorQuantities()
{
  return {drift(),
          figure("drift [%]", &RunFigures::drift_percent),
          figure("at the IMU's rate [m]", &RunFigures::imu_rate_drift),
          figure("floor [m]", &RunFigures::floor),
          figure("APE [m]", &RunFigures::ape),
          figure("RPE [m]", &RunFigures::rpe),
          figure("RPE [deg]", &RunFigures::rpe_deg),
          figure("path [m]", &RunFigures::path),
          health()};
}

std::vector<Quantity> costQuantities(const std::vector<StudyCell>& cells)
{
  std::vector<Quantity> quantities;
  for (const std::string& stage : stagesOf(cells)) quantities.push_back(millisecondsOf(stage));
  quantities.push_back(cost("real-time factor", &RunCosts::real_time_factor));
  quantities.push_back(cost("memory [MB]", &RunCosts::peak_memory_mb));
  return quantities;
}
}  // namespace scanloom
