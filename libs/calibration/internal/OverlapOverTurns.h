/** What two lidars see in the same place, over several turns. */
#pragma once
#include "base/core/PointCloud.h"
#include "base/core/Rigid.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace scanloom
{
/** What one lidar sees during a turn, or several turns seen from one place, in the body frame. */
struct SeenPoints
{
  PointCloud points;
  std::vector<std::uint8_t> own;  // 1 where a point is on the machine itself; empty: none is known to be
};

/** The points without those known to be on the machine itself. */
PointCloud surroundings(const SeenPoints&);

/** What two lidars see of the same place. */
struct SeenByBoth
{
  const SeenPoints* a;
  const SeenPoints* b;
};

/** Medians over the turns with at least 500 common points. */
struct OverlapOverTurns
{
  std::vector<SeenByBoth> turns;  // these
  std::size_t common = 0;         // points of A in a turn that B should see, too (CoVisiblePoints)
  double near_share = 0;          // of these: points with one of B within 0.3 m
  double near_sigma = 0;          // standard deviation of near_share, by its scatter over three turns or more
};

/** A's points are moved by `correction` first. None if no turn has enough common points. */
std::optional<OverlapOverTurns> sharedView(const std::vector<SeenByBoth>&, const Rigid& correction,
                                           const Rigid& body_T_b);
}  // namespace scanloom
