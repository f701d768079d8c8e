#pragma once
#include "estimation/slam/StateEstimate.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace scanloom
{
/** What a run counts of its scans and estimates, and how it went by them. */
struct RunCounts
{
  std::uint64_t scans = 0, imu_changes = 0;
  std::uint64_t poses = 0, initialising = 0, degenerate = 0, lost = 0, keyframes = 0;
  std::uint64_t registered = 0;  // poses that a registration measured, trusted or not
  std::uint64_t cut_scans = 0, imu_short = 0;
  std::uint64_t map_jumps = 0;  // poses
  double largest_shift = 0;     // m, StateEstimate::map_shift
  Health last = Health::Ok;
  std::optional<Timestamp> first;  // pose
  Timestamp newest;

  void add(const StateEstimate&);

  double recorded() const { return first ? seconds(newest - *first) : 0; }  // s

  /** At the end, or for more than 5 % of the poses. */
  bool isLost() const { return last == Health::Lost || 20 * lost > poses; }

  /** A pose was measured, the body is not lost, at most 5 % of the poses are not to be relied on, and the map never
   * jumped. */
  bool passed() const { return registered > 0 && !isLost() && 20 * (lost + degenerate) <= poses && map_jumps == 0; }

  std::string outcome() const;
  void addTo(std::map<std::string, std::uint64_t>& counts) const;
};
}  // namespace scanloom
