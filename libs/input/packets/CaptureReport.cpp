#include "input/packets/CaptureReport.h"

#include "base/core/jsonText.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace scanloom
{
namespace
{
double secondsOf(Timestamp t) { return seconds(t.time_since_epoch()); }
}  // namespace

std::string toJson(const CaptureInfo& info)
{
  using nlohmann::json;
  const CaptureCounters& c = info.counters;
  json result = {{"records", c.records},
                 {"datagrams", c.datagrams},
                 {"fragments_joined", c.fragments_joined},
                 {"fragments_expired", c.fragments_expired},
                 {"not_udp", c.not_udp},
                 {"cut_short", c.cut_short},
                 {"malformed", c.malformed},
                 {"truncated", c.truncated},
                 {"damage", fmt::format("{}", fmt::join(c.damages, "; "))}};
  result["streams"] = json::array();
  for (const CaptureStream& s : info.streams)
    result["streams"].push_back({{"source", s.source.text()},
                                 {"port", s.destination_port},
                                 {"datagrams", s.datagrams},
                                 {"smallest_bytes", s.smallest},
                                 {"largest_bytes", s.largest},
                                 {"first_s", secondsOf(s.first)},
                                 {"last_s", secondsOf(s.last)}});
  result["lidars"] = json::array();
  for (const DecodedCapture& lidar : info.lidars)
  {
    json decoded = {{"model", lidar.lidar.model},
                    {"serial", lidar.lidar.serial},
                    {"packets", lidar.packets},
                    {"valid_blocks", lidar.valid_blocks},
                    {"invalid_blocks", lidar.invalid_blocks},
                    {"imu_samples", lidar.imu_samples},
                    {"first_s", secondsOf(lidar.first)},
                    {"last_s", secondsOf(lidar.last)}};
    result["lidars"].push_back(std::move(decoded));
  }
  return jsonText(result) + '\n';
}

std::string toText(const CaptureInfo& info)
{
  const CaptureCounters& c = info.counters;
  std::string text = fmt::format(
      "{} records: {} datagrams ({} joined from fragments), {} incomplete, {} not UDP, {} cut short, {} malformed{}\n",
      c.records, c.datagrams, c.fragments_joined, c.fragments_expired, c.not_udp, c.cut_short, c.malformed,
      c.truncated ? "; the file ends inside a record" : "");
  for (const std::string& damage : c.damages) text += damage + '\n';
  for (const CaptureStream& s : info.streams)
    text += fmt::format("  {:>15} -> port {:<5}  {:>8} datagrams of {} to {} bytes in {:.3f} s\n", s.source.text(),
                        s.destination_port, s.datagrams, s.smallest, s.largest, seconds(s.last - s.first));
  for (const DecodedCapture& lidar : info.lidars)
  {
    text += fmt::format("{} {}: {} valid blocks, {} invalid, {} IMU samples, {:.3f} s of sensor time\n",
                        lidar.lidar.model, lidar.lidar.serial, lidar.valid_blocks, lidar.invalid_blocks,
                        lidar.imu_samples, seconds(lidar.last - lidar.first));
    for (const auto& [kind, packets] : lidar.packets) text += fmt::format("  {:<10} {:>8} packets\n", kind, packets);
  }
  return text;
}
}  // namespace scanloom
