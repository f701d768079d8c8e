#include "calibration/ExtrinsicsReport.h"

#include "calibration/internal/ExtrinsicsNumbers.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace scanloom
{
namespace
{
const char* toString(ExtrinsicsOutcome outcome)
{
  switch (outcome)
  {
    case ExtrinsicsOutcome::Estimated:
      return "ESTIMATED";
    case ExtrinsicsOutcome::Open:
      return "OPEN";
    case ExtrinsicsOutcome::StoodStill:
      return "STOOD STILL";
    case ExtrinsicsOutcome::NothingShared:
      return "NOTHING SHARED";
    case ExtrinsicsOutcome::Unstable:
      return "UNSTABLE";
    case ExtrinsicsOutcome::Contradicted:
      return "CONTRADICTED";
  }
  return "";
}

std::string reasonOf(const std::string& reference, const ExtrinsicsEstimate& e)
{
  switch (e.outcome)
  {
    case ExtrinsicsOutcome::StoodStill:
      return fmt::format("only {} places at least 0.7 m or 10 deg apart, 10 are needed: drive 10 m or more, with turns",
                         e.stations);
    case ExtrinsicsOutcome::NothingShared:
      return fmt::format(
          "only {:.0f} % of what it saw is where '{}' saw something: it is covered, or its pose is wrong by more than "
          "20 "
          "deg or 0.5 m, or both see no place in common (a drive: within 7 m of it)",
          100 * e.shared_after, reference);
    case ExtrinsicsOutcome::Unstable:
      return fmt::format(
          "the estimate did not settle, or does not fit (surfaces {:.3f} m apart, {:.3f} m within the scans of '{}'): "
          "drive where there are stems or walls on all sides",
          e.distance_after, e.distance_of_reference, reference);
    case ExtrinsicsOutcome::Contradicted:
      return fmt::format(
          "where it fits best, the IMUs inside it and '{}' measure another rotation between them: drive where "
          "there are stems or walls on all sides, with turns, and see that the metadata are those of these lidars",
          reference);
    default:
      return "";
  }
}
}  // namespace

bool trusted(const ExtrinsicsEstimate& estimate) { return estimate.outcome == ExtrinsicsOutcome::Estimated; }

std::string inWords(const std::string& lidar, const std::string& reference, const ExtrinsicsEstimate& e,
                    const TimeOffset& time_offset)
{
  if (e.outcome != ExtrinsicsOutcome::Estimated && e.outcome != ExtrinsicsOutcome::Open)
    return fmt::format("{}: not calibrated: {}\n", lidar, reasonOf(reference, e));
  const double clock_sigma = std::sqrt(e.covariance(6, 6));
  std::string words = fmt::format("{}: {}\n", lidar, poseInWords(e.extrinsics, e.covariance));
  if (clock_sigma > 0)
    words += fmt::format("{}: its stamps are {:.2f} ms late (+- {:.2f}); set {} = {:.6f}\n", lidar,
                         1e3 * e.extrinsics.clock_offset, 1e3 * clock_sigma, time_offset.key,
                         time_offset.value - e.extrinsics.clock_offset);
  const std::string places = e.stations > 1 ? fmt::format("at {} places, ", e.stations) : "";
  words += fmt::format(
      "{}: {}{:.0f} % of its points (before: {:.0f} %) are where '{}' saw something; surfaces {:.3f} m apart (before: "
      "{:.3f} m){}\n",
      lidar, places, 100 * e.shared_after, 100 * e.shared_before, reference, e.distance_after, e.distance_before,
      e.distance_of_reference > 0
          ? fmt::format("; {:.3f} m within the scans of '{}'", e.distance_of_reference, reference)
          : "");
  return words + openInWords(lidar, e.open);
}

nlohmann::json toJson(const std::string& lidar, const ExtrinsicsEstimate& e)
{
  nlohmann::json json = numbersOf(e.extrinsics, e.covariance, e.open);
  json["lidar"] = lidar;
  json["outcome"] = toString(e.outcome);
  json["stations"] = e.stations;
  json["shared_before"] = e.shared_before;
  json["shared_after"] = e.shared_after;
  json["surface_distance_before"] = e.distance_before;
  json["surface_distance_after"] = e.distance_after;
  json["surface_distance_of_reference"] = e.distance_of_reference;
  return json;
}
}  // namespace scanloom
