#include "mrpt/edit/RawlogReport.h"

#include "base/core/jsonText.h"
#include "mrpt/observations/RecordingHeaderJson.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace scanloom
{
std::string toJson(const RawlogInfo& info)
{
  using nlohmann::json;
  json result = {{"observations", info.observations()},
                 {"points", info.points()},
                 {"span_s", seconds(info.span())},
                 {"file_bytes", info.file_size},
                 {"damage", info.damage}};
  result["sensors"] = json::array();
  for (const RawlogSensor& s : info.sensors)
    result["sensors"].push_back({{"label", s.label},
                                 {"class", s.observation_class},
                                 {"cloud_class", s.cloud_class},
                                 {"count", s.count},
                                 {"points", s.points},
                                 {"first_s", seconds(s.first.time_since_epoch())},
                                 {"last_s", seconds(s.last.time_since_epoch())}});
  if (info.header) result["header"] = json::parse(toJson(*info.header));
  return jsonText(result) + '\n';
}

std::string toText(const RawlogInfo& info)
{
  std::string text = fmt::format("{} observations, {} points, {:.3f} s, {:.1f} MB\n", info.observations(),
                                 info.points(), seconds(info.span()), 1e-6 * static_cast<double>(info.file_size));
  if (info.header)
    for (const RecordedLidar& lidar : info.header->lidars)
      text += fmt::format("  lidar '{}': {} {}, {} beams, {} columns a turn\n", lidar.name, lidar.model, lidar.serial,
                          lidar.beams, lidar.columns);
  for (const RawlogSensor& s : info.sensors)
  {
    const double span = seconds(s.last - s.first);
    const double rate = span > 0 ? static_cast<double>(s.count - 1) / span : 0.0;
    text += fmt::format("  {:<16} {:<36} {:>8} in {:.3f} s ({:.2f} Hz), {} points {}\n", s.label, s.observation_class,
                        s.count, span, rate, s.points, s.cloud_class);
  }
  if (!info.damage.empty()) text += fmt::format("damaged: {}\n", info.damage);
  return text;
}
}  // namespace scanloom
