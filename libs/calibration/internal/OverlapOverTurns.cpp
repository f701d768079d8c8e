#include "calibration/internal/OverlapOverTurns.h"

#include "base/core/Statistics.h"
#include "calibration/internal/CoVisiblePoints.h"

#include <cmath>

namespace scanloom
{
PointCloud surroundings(const SeenPoints& seen)
{
  PointCloud points = seen.points;
  if (seen.own.empty()) return points;
  std::vector<std::uint8_t> keep;
  for (const std::uint8_t own : seen.own) keep.push_back(own ? 0 : 1);
  points.keep(keep);
  return points;
}

std::optional<OverlapOverTurns> sharedView(const std::vector<SeenByBoth>& turns, const Rigid& correction,
                                           const Rigid& body_T_b)
{
  constexpr std::size_t kFewestCommon = 500, kFewestForSigma = 3;
  constexpr double kOfMedian = 1.2533;  // its deviation over that of the mean, for normally distributed values
  OverlapOverTurns shared;
  std::vector<double> common, near_share;
  for (const SeenByBoth& turn : turns)
  {
    const CoVisiblePoints view = commonView(surroundings(*turn.a), correction, turn.b->points, body_T_b);
    if (view.common < kFewestCommon) continue;
    shared.turns.push_back(turn);
    common.push_back(static_cast<double>(view.common));
    near_share.push_back(static_cast<double>(view.near) / common.back());
  }
  if (shared.turns.empty()) return std::nullopt;
  shared.common = static_cast<std::size_t>(median(common));
  shared.near_share = median(near_share);
  if (near_share.size() >= kFewestForSigma)
    shared.near_sigma = kOfMedian * robustDeviation(near_share) / std::sqrt(static_cast<double>(near_share.size()));
  return shared;
}
}  // namespace scanloom
