#include "run/page/internal/ViewStatus.h"

#include <algorithm>

namespace scanloom
{
double silenceOf(const ViewedLidar& lidar, const ViewStatus& status, std::chrono::steady_clock::time_point now)
{
  if (!status.newest) return 0;
  const double by_scans = seconds(*status.newest - lidar.seen.value_or(*status.first));
  if (!status.live || status.ended) return by_scans;
  return by_scans + std::max(0.0, std::chrono::duration<double>(now - status.scan_came).count());
}

std::string wordFor(const ViewStatus& status, std::chrono::steady_clock::time_point now)
{
  if (status.ended) return "ENDED";
  if (status.health == "LOST") return status.health;
  const auto silent = [&](const ViewedLidar& lidar) { return silenceOf(lidar, status, now) > kSilent; };
  if (std::any_of(status.lidars.begin(), status.lidars.end(), silent)) return "SILENT";
  if (status.player) return status.player->playing ? "PLAYING" : "PAUSED";
  if (!status.health.empty()) return status.health;
  return status.scans == 0 ? "WAITING" : "RUNNING";
}
}  // namespace scanloom
