#include "input/batching/internal/LidarNotices.h"

#include <utility>

namespace scanloom
{
void LidarNotices::note(LidarIndex lidar, Notice::Kind kind, Timestamp now, Duration duration)
{
  notices_.push_back({kind, lidar, now, duration, lidars_[lidar].flags});
}

void LidarNotices::noteFlags(LidarIndex lidar, std::uint32_t flags, Timestamp now)
{
  if (std::exchange(lidars_[lidar].flags, flags) != flags) note(lidar, Notice::Kind::Alert, now);
}

void LidarNotices::noteArrival(LidarIndex lidar, Timestamp received)
{
  Lidar& of = lidars_[lidar];
  of.silence = of.latest_arrival ? received - *of.latest_arrival : Duration{0};
  of.latest_arrival = received;
}

void LidarNotices::noteSilent(LidarIndex lidar, Timestamp now)
{
  if (!std::exchange(lidars_[lidar].silent, true)) note(lidar, Notice::Kind::Silent, now);
}

void LidarNotices::noteBack(LidarIndex lidar, Timestamp now)
{
  if (std::exchange(lidars_[lidar].silent, false)) note(lidar, Notice::Kind::Back, now, lidars_[lidar].silence);
}

std::vector<Notice> LidarNotices::take() { return std::exchange(notices_, {}); }
}  // namespace scanloom
