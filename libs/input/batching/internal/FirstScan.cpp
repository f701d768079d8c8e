#include "input/batching/internal/FirstScan.h"

#include <algorithm>

namespace scanloom
{
std::optional<Timestamp> latestFirstStamp(const std::vector<LidarBeforeStart>& lidars, Duration period,
                                          std::optional<Timestamp> now)
{
  Timestamp earliest = Timestamp::max();
  Duration quickest = Duration::max();
  for (const LidarBeforeStart& lidar : lidars)
  {
    if (!lidar.first_stamp) continue;
    earliest = std::min(earliest, *lidar.first_stamp);
    quickest = std::min(quickest, lidar.delay);
  }
  if (earliest == Timestamp::max()) return std::nullopt;

  Timestamp latest = earliest;
  for (const LidarBeforeStart& lidar : lidars)
  {
    const Timestamp waited_for = std::min(lidar.first_stamp.value_or(Timestamp::max()), earliest + period);
    const Duration delay = lidar.first_stamp ? lidar.delay : quickest;
    if (now && *now - delay - lidar.patience < waited_for) return std::nullopt;
    if (lidar.first_stamp == waited_for) latest = std::max(latest, waited_for);
  }
  return latest;
}

Timestamp startAfter(Timestamp latest_first_stamp, Duration period, Duration phase)
{
  const Duration past_grid = (latest_first_stamp.time_since_epoch() - phase) % period;
  return latest_first_stamp - (past_grid + period) % period + period;
}

Timestamp startOfWholeScan(Timestamp latest_first_stamp, Duration period, Duration phase, Duration room)
{
  const Timestamp next = startAfter(latest_first_stamp, period, phase);
  return latest_first_stamp - (next - period) < room ? next - period : next;
}
}  // namespace scanloom
