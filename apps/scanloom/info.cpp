/** `scanloom info`: what a capture or a rawlog holds. */
#include "Arguments.h"
#include "RawlogReport.h"
#include "Verb.h"
#include "config/ConfigError.h"
#include "dataset/CaptureInfo.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
using nlohmann::json;

struct InfoArguments
{
  std::filesystem::path file;
  std::vector<std::string> metadata;
  bool digests = false;
  bool json = false;
};

double secondsOf(Timestamp t) { return seconds(t.time_since_epoch()); }

json toJson(const CaptureInfo& info)
{
  json result;
  const CaptureCounters& c = info.counters;
  result["records"] = c.records;
  result["datagrams"] = c.datagrams;
  result["fragments_joined"] = c.fragments_joined;
  result["fragments_expired"] = c.fragments_expired;
  result["not_udp"] = c.not_udp;
  result["cut_short"] = c.cut_short;
  result["malformed"] = c.malformed;
  result["truncated"] = c.truncated;
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
    if (!lidar.digests.empty()) decoded["scans"] = lidar.digests;
    result["lidars"].push_back(std::move(decoded));
  }
  if (info.lidars.size() == 1 && !info.lidars.front().digests.empty()) result["scans"] = info.lidars.front().digests;
  return result;
}

void print(const CaptureInfo& info)
{
  const CaptureCounters& c = info.counters;
  fmt::print(
      "{} records: {} datagrams ({} joined from fragments), {} incomplete, {} not UDP, {} cut short, {} malformed{}\n",
      c.records, c.datagrams, c.fragments_joined, c.fragments_expired, c.not_udp, c.cut_short, c.malformed,
      c.truncated ? "; the file ends inside a record" : "");
  for (const CaptureStream& s : info.streams)
    fmt::print("  {:>15} -> port {:<5}  {:>8} datagrams of {} to {} bytes in {:.3f} s\n", s.source.text(),
               s.destination_port, s.datagrams, s.smallest, s.largest, seconds(s.last - s.first));
  for (const DecodedCapture& lidar : info.lidars)
  {
    fmt::print("{} {}: {} valid blocks, {} invalid, {} IMU samples, {:.3f} s of sensor time\n", lidar.lidar.model,
               lidar.lidar.serial, lidar.valid_blocks, lidar.invalid_blocks, lidar.imu_samples,
               seconds(lidar.last - lidar.first));
    for (const auto& [kind, packets] : lidar.packets) fmt::print("  {:<10} {:>8} packets\n", kind, packets);
    for (const auto& turn : lidar.digests)
      for (const auto& [field, digest] : turn) fmt::print("  {:<16} {}\n", field, digest);
  }
}

template <typename Info>
void report(const Info& info, bool as_json)
{
  if (as_json)
    std::cout << toJson(info).dump(2) << '\n';
  else
    print(info);
}

int run(const InfoArguments& arguments)
{
  if (isCapture(arguments.file))
  {
    if (arguments.digests && arguments.metadata.empty())
      throw UsageError("--digests needs the sensor's metadata: --metadata FILE.json");
    report(captureInfo(arguments.file, arguments.metadata, arguments.digests ? Digests::Yes : Digests::No),
           arguments.json);
    return kDone;
  }
  if (!arguments.metadata.empty() || arguments.digests)
    throw UsageError(
        fmt::format("{} is no capture: --metadata and --digests are for pcap and pcapng", arguments.file.string()));
  const RawlogInfo info = rawlogInfo(arguments.file);
  report(info, arguments.json);
  return info.damage.empty() ? kDone : kQualityGate;
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<InfoArguments>();
  app.add_option("FILE", arguments->file, "capture (pcap, pcapng) or rawlog")->required();
  app.add_option("--metadata", arguments->metadata, "metadata JSON of a lidar in the capture (repeatable)");
  app.add_flag("--digests", arguments->digests, "md5 of every channel field, turn by turn");
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb infoVerb() { return {"info", "what a capture or a rawlog holds", {}, &addOptions}; }
}  // namespace scanloom
