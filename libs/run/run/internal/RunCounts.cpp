#include "run/run/internal/RunCounts.h"

#include <algorithm>

namespace scanloom
{
void RunCounts::add(const StateEstimate& estimate)
{
  ++poses;
  initialising += estimate.health == Health::Initialising;
  degenerate += estimate.health == Health::Degenerate;
  registered += estimate.registration.has_value();
  lost += estimate.health == Health::Lost;
  keyframes += estimate.keyframe.has_value();
  cut_scans += !estimate.scan_complete;
  imu_short += !estimate.imu_complete;
  map_jumps += estimate.mapJumped();
  largest_shift = std::max(largest_shift, estimate.map_shift);
  last = estimate.health;
  if (!first) first = estimate.stamp;
  newest = estimate.stamp;
}

std::string RunCounts::outcome() const
{
  if (registered == 0) return "NOTHING";
  if (map_jumps > 0) return "MAP JUMPED";
  if (isLost()) return "LOST";
  if (last == Health::Initialising) return "INITIALISING";
  return degenerate + lost > 0 ? "DEGENERATE" : "OK";
}

void RunCounts::addTo(std::map<std::string, std::uint64_t>& counts) const
{
  counts["scans"] = scans;
  counts["imu_changes"] = imu_changes;
  counts["scans_cut"] = cut_scans;
  counts["scans_without_full_imu"] = imu_short;
  counts["poses"] = poses;
  counts["poses_initialising"] = initialising;
  counts["poses_degenerate"] = degenerate;
  counts["poses_lost"] = lost;
  counts["keyframes"] = keyframes;
  counts["map_jumps"] = map_jumps;
}
}  // namespace scanloom
