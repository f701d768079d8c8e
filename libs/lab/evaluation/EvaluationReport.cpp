#include "lab/evaluation/EvaluationReport.h"

#include "base/formats/SecondsText.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>

namespace scanloom
{
namespace
{
using Json = nlohmann::json;

template <typename Value>
Json orNull(const std::optional<Value>& value)
{
  return value ? Json(*value) : Json();
}

Json sizeJson(const std::optional<ErrorSize>& size, const std::string& unit)
{
  if (!size) return Json::object();
  return {{"rmse_" + unit, size->rmse}, {"largest_" + unit, size->largest}};
}

Json errorsJson(const PoseErrors& errors)
{
  Json json = sizeJson(errors.metres, "m");
  json.update(sizeJson(errors.degrees, "deg"));
  json["compared"] = errors.compared;
  return json;
}

Json overDistanceJson(const Drift& drift)
{
  Json rows = Json::array();
  for (const auto& [distance, error] : drift.over_distance)
    rows.push_back({{"distance_m", distance}, {"error_m", error}});
  return rows;
}

Json driftJson(const Drift& drift)
{
  return {{"drift_m", drift.largest}, {"drift_percent", orNull(drift.percent())}, {"samples", drift.samples}};
}

std::string driftText(const char* what, const Drift& drift)
{
  const auto percent = drift.percent();
  return fmt::format("{:<26}{:.3f} m{}\n", what, drift.largest, percent ? fmt::format(" ({:.2f} %)", *percent) : "");
}

std::string alignmentText(const Drift& drift)
{
  const auto& [transform, lever, condition] = drift.alignment;
  return fmt::format(
      "aligned on                {} of {} samples, {:.2f} m from the axis of the least certain rotation (rms), "
      "condition "
      "{:.3g}\n",
      drift.fitted, drift.samples, lever, condition);
}

std::string errorsText(const char* what, const PoseErrors& errors)
{
  if (errors.compared == 0) return fmt::format("{:<26}nothing to compare\n", what);
  const std::string turned =
      errors.degrees ? fmt::format(", {:.3f} deg (largest {:.3f})", errors.degrees->rmse, errors.degrees->largest) : "";
  return fmt::format("{:<26}rmse {:.3f} m (largest {:.3f}){} of {}\n", what, errors.metres.rmse, errors.metres.largest,
                     turned, errors.compared);
}

std::string clockText(const Evaluation& e)
{
  if (!e.clock_offset) return "clock of the reference    offset not observable\n";
  return fmt::format("clock of the reference    {:.4f} s late, estimated from positions; {}\n",
                     seconds(*e.clock_offset), e.clock_offset_applied ? "corrected" : "not corrected");
}

constexpr int kRows = 10;

/** The largest error up to each tenth of the path. */
std::string overDistanceText(const Drift& drift)
{
  if (drift.path_length == 0) return "";
  std::string text = "\ndistance    largest error up to it\n";
  double largest = 0;
  std::size_t next = 0;
  for (int row = 1; row <= kRows; ++row)
  {
    const double distance = drift.path_length * row / kRows;
    for (; next < drift.over_distance.size() && drift.over_distance[next].distance <= distance; ++next)
      largest = std::max(largest, drift.over_distance[next].error);
    text += fmt::format("{:>8.1f} m  {:.3f} m\n", distance, largest);
  }
  return text;
}
}  // namespace

Json toJson(const Evaluation& e)
{
  Json json = driftJson(e.drift);
  json.update({{"largest_at_s", secondsText(e.drift.largest_at)},
               {"final_m", e.drift.final},
               {"path_m", e.drift.path_length},
               {"samples_left_out", e.left_out},
               {"covered_percent", 100 * e.covered},
               {"ape_rmse_m", e.absolute.metres.rmse},
               {"ape", errorsJson(e.absolute)},
               {"rpe", errorsJson(e.relative)},
               {"clock_offset_applied", e.clock_offset_applied},
               {"drift_over_distance", overDistanceJson(e.drift)}});
  json["clock_offset_s"] = e.clock_offset ? Json(seconds(*e.clock_offset)) : Json();
  json["alignment"] = {
      {"samples", e.drift.fitted}, {"lever_m", e.drift.alignment.lever}, {"condition", e.drift.alignment.condition}};
  json["imu_rate"] = e.imu_rate_drift ? driftJson(*e.imu_rate_drift) : Json();
  json["floor"] = e.floor ? driftJson(*e.floor) : Json();
  return json;
}

std::string toText(const Evaluation& e)
{
  std::string text = driftText("drift", e.drift);
  if (e.imu_rate_drift) text += driftText("  at the IMU's rate", *e.imu_rate_drift);
  if (e.floor) text += driftText("  straight between scans", *e.floor);
  text += fmt::format("largest at                {} s, at the end {:.3f} m\n", secondsText(e.drift.largest_at),
                      e.drift.final);
  text += fmt::format("path                      {:.2f} m, {} samples, {} left out: {:.1f} % of the reference's time\n",
                      e.drift.path_length, e.drift.samples, e.left_out, 100 * e.covered);
  text += alignmentText(e.drift);
  text += errorsText("APE", e.absolute) + errorsText("RPE", e.relative) + clockText(e);
  return text + overDistanceText(e.drift);
}

Json toJson(const PositionError& error)
{
  return {{"poses", error.poses},
          {"largest_m", error.largest},
          {"largest_at_s", secondsText(error.largest_at)},
          {"rmse_m", error.root_mean_square},
          {"final_m", error.final},
          {"path_length_m", error.path_length},
          {"covered_percent", 100 * error.covered}};
}

std::string toText(const PositionError& error)
{
  return fmt::format(
      "largest position error  {:.3f} m at {} s\nroot mean square        {:.3f} m\nat the end              {:.3f} m\n"
      "compared                {} poses over {:.2f} m, {:.1f} % of the reference's time\n",
      error.largest, secondsText(error.largest_at), error.root_mean_square, error.final, error.poses, error.path_length,
      100 * error.covered);
}
}  // namespace scanloom
