#include "RawlogReport.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
double secondsOf(Timestamp t) { return seconds(t.time_since_epoch()); }
}  // namespace

using nlohmann::json;

json toJson(const RawlogInfo& info)
{
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
                                 {"first_s", secondsOf(s.first)},
                                 {"last_s", secondsOf(s.last)}});
  if (info.header) result["header"] = json::parse(toJson(*info.header));
  return result;
}

void print(const RawlogInfo& info)
{
  fmt::print("{} observations, {} points, {:.3f} s, {:.1f} MB\n", info.observations(), info.points(),
             seconds(info.span()), 1e-6 * static_cast<double>(info.file_size));
  if (info.header)
    for (const RecordedLidar& lidar : info.header->lidars)
      fmt::print("  lidar '{}': {} {}, {} beams, {} columns a turn\n", lidar.name, lidar.model, lidar.serial,
                 lidar.beams, lidar.columns);
  for (const RawlogSensor& s : info.sensors)
  {
    const double span = seconds(s.last - s.first);
    fmt::print("  {:<16} {:<36} {:>8} in {:.3f} s ({:.2f} Hz), {} points {}\n", s.label, s.observation_class, s.count,
               span, span > 0 ? static_cast<double>(s.count - 1) / span : 0.0, s.points, s.cloud_class);
  }
  if (!info.damage.empty()) fmt::print("damaged: {}\n", info.damage);
}
}  // namespace scanloom
