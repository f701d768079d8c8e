#pragma once
#include "slam/StateEstimate.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace scanloom
{
/** How a run went, from its estimates. */
struct HealthCounts
{
  std::uint64_t poses = 0, initialising = 0, degenerate = 0, lost = 0, keyframes = 0;
  std::uint64_t cut_scans = 0, imu_short = 0;
  Health last = Health::Ok;
  std::optional<Timestamp> first;
  Timestamp newest;

  void add(const StateEstimate&);

  double recorded() const { return first ? seconds(newest - *first) : 0; }  // s

  /** Not LOST at the end or for more than 5 % of the poses, of which there are some. */
  bool passed() const { return poses > 0 && last != Health::Lost && 20 * lost <= poses; }

  std::string outcome() const;
  void addTo(std::map<std::string, std::uint64_t>& counts) const;
};
}  // namespace scanloom
