#include "run/page/internal/ViewStatusJson.h"

#include <unistd.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <system_error>

namespace scanloom
{
namespace
{
using Clock = std::chrono::steady_clock;
using nlohmann::json;

json lidarJson(const ViewedLidar& lidar, const ViewStatus& status, Clock::time_point now)
{
  return {{"name", lidar.name},
          {"model", lidar.model},
          {"rate", lidar.rate},
          {"lost", lidar.lost},
          {"left_out", lidar.left_out},
          {"clock_offset", lidar.clock_offset ? json(*lidar.clock_offset) : json()},
          {"silence", silenceOf(lidar, status, now)},
          {"silent", silenceOf(lidar, status, now) > kSilent},
          {"returns", lidar.returns},
          {"usual_returns", lidar.usual_returns}};
}

json playerJson(const PlayerStatus& player)
{
  return {
      {"playing", player.playing}, {"speed", player.speed}, {"position", player.position}, {"length", player.length}};
}
}  // namespace

ComputerStatus computerStatus(const std::filesystem::path& folder)
{
  ComputerStatus status;
  std::error_code none;
  status.disk_free = std::filesystem::space(folder, none).available;
  if (none) status.disk_free = 0;
  std::uint64_t pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  status.memory = resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return status;
}

std::string toJson(const ViewStatus& status, const ComputerStatus& computer, Clock::time_point now)
{
  json event = {{"verb", status.verb},
                {"live", status.live},
                {"word", wordFor(status, now)},
                {"health", status.health},
                {"why", status.why},
                {"scans", status.scans},
                {"poses", status.poses},
                {"keyframes", status.keyframes},
                {"keyframes_left_out", status.keyframes_left_out},
                {"marks", status.marks},
                {"recorded", status.newest ? seconds(*status.newest - *status.first) : 0},
                {"distance", status.distance},
                {"speed", status.speed},
                {"disk_free", computer.disk_free},
                {"memory", computer.memory},
                {"lidars", json::array()},
                {"imus", json::array()},
                {"warnings", json::array()},
                {"newest_marks", json::array()}};
  if (status.factor) event["factor"] = *status.factor;
  if (status.player) event["player"] = playerJson(*status.player);
  for (const ViewedLidar& lidar : status.lidars) event["lidars"].push_back(lidarJson(lidar, status, now));
  for (const ViewedImu& imu : status.imus)
    event["imus"].push_back(
        {{"name", imu.name}, {"rate", imu.rate}, {"silence", status.newest ? seconds(*status.newest - imu.seen) : 0}});
  for (const CountedWarning& warning : status.warnings)
    event["warnings"].push_back({{"text", warning.text},
                                 {"count", warning.count},
                                 {"age", std::chrono::duration<double>(now - warning.last).count()}});
  for (const ShownMark& mark : status.newest_marks)
    event["newest_marks"].push_back({{"text", mark.text}, {"after", mark.after}});
  // Names and warnings may quote files: what is no UTF-8 must not end the stream.
  return event.dump(-1, ' ', false, json::error_handler_t::replace);
}
}  // namespace scanloom
