#include "mrpt/observations/RecordingHeaderJson.h"

#include "base/core/Text.h"
#include "base/core/jsonText.h"
#include "input/batching/Scan.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace scanloom
{
namespace
{
using nlohmann::json;

constexpr const char* kRecordedRate = "recorded_scan_rate";
constexpr double kFarthestLidar = 1e4;  // m

json toRows(const Eigen::Matrix4d& m)
{
  json rows = json::array();
  for (int r = 0; r < 4; r++) rows.push_back({m(r, 0), m(r, 1), m(r, 2), m(r, 3)});
  return rows;
}

Eigen::Matrix4d fromRows(const json& rows)
{
  Eigen::Matrix4d m;
  for (int r = 0; r < 4; r++)
    for (int c = 0; c < 4; c++) m(r, c) = rows.at(r).at(c).get<double>();
  return m;
}

[[noreturn]] void refuse(const std::string& why)
{
  throw std::invalid_argument(fmt::format("the rawlog's header (first comment, JSON) is damaged: {}", why));
}

/** 0: unknown. */
double rateFrom(const char* key, double rate)
{
  constexpr double kLeast = 0.1, kMost = 1000;  // Hz, as of BatcherOptions
  if (rate != 0 && !(rate >= kLeast && rate <= kMost))
    refuse(fmt::format("{} = {} Hz: must be {} to {}, or 0 if it is unknown", key, rate, kLeast, kMost));
  return rate;
}

RecordedLidar lidarFromJson(const json& j)
{
  RecordedLidar lidar;
  lidar.name = printable(j.at("name").get<std::string>());
  lidar.serial = printable(j.at("serial").get<std::string>());
  lidar.model = printable(j.at("model").get<std::string>());
  lidar.body_T_sensor = Rigid::fromMatrix(fromRows(j.at("body_T_sensor")));
  if (!(lidar.body_T_sensor.translation.norm() <= kFarthestLidar))
    refuse(fmt::format("lidar '{}' is more than {} m from the body", lidar.name, kFarthestLidar));
  lidar.beams = j.at("beams").get<int>();
  lidar.columns = j.at("columns").get<int>();
  lidar.clock = printable(j.at("clock").get<std::string>());
  return lidar;
}
}  // namespace

std::string toJson(const RecordingHeader& header)
{
  json lidars = json::array();
  for (const auto& lidar : header.lidars)
    lidars.push_back({{"sensor_id", lidars.size()},
                      {"name", lidar.name},
                      {"serial", lidar.serial},
                      {"model", lidar.model},
                      {"body_T_sensor", toRows(lidar.body_T_sensor.matrix())},
                      {"beams", lidar.beams},
                      {"columns", lidar.columns},
                      {"clock", lidar.clock}});
  json content = {{"version", header.version.empty() ? SCANLOOM_VERSION : header.version},
                  {"scan_rate", header.scan_rate},
                  {"lidars", lidars}};
  if (header.recorded_rate > 0) content[kRecordedRate] = header.recorded_rate;
  return jsonText({{"scanloom", content}}, 1);
}

std::string withScanRate(const std::string& header, double scan_rate)
{
  json document = json::parse(header);
  json& content = document.at("scanloom");
  const double recorded = content.value(kRecordedRate, content.at("scan_rate").get<double>());
  content.at("scan_rate") = scan_rate;
  if (scan_rate == recorded)
    content.erase(kRecordedRate);
  else
    content[kRecordedRate] = recorded;
  return jsonText(document, 1);
}

std::optional<RecordingHeader> recordingHeaderFromJson(const std::string& text)
{
  const json document = json::parse(text, nullptr, false);
  if (!document.is_object() || !document.contains("scanloom")) return std::nullopt;
  try
  {
    const json& content = document.at("scanloom");
    RecordingHeader header;
    header.version = content.at("version").get<std::string>();
    header.scan_rate = rateFrom("scan_rate", content.at("scan_rate").get<double>());
    header.recorded_rate = rateFrom(kRecordedRate, content.value(kRecordedRate, 0.0));
    for (const json& lidar : content.at("lidars")) header.lidars.push_back(lidarFromJson(lidar));
    if (header.lidars.size() > kMostLidars)
      refuse(fmt::format("{} lidars: must be at most {}", header.lidars.size(), kMostLidars));
    return header;
  }
  catch (const json::exception& e)
  {
    refuse(reasonOf(e));
  }
}
}  // namespace scanloom
