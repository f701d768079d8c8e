#include "calibration/internal/MountFit.h"

#include "calibration/internal/MountEquations.h"

#include <algorithm>

namespace scanloom
{
MountFit mountFit(const std::vector<Station>& stations, const Mount& mount, const Trajectory& trajectory)
{
  constexpr MountLevel kFitLevel{1.0, 1.0};
  const std::vector<NdtMap> reference = mapsOfReference(stations, kFitLevel);
  const StationCells lidar = cellsOfLidar(stations, mount, trajectory, kFitLevel);
  std::vector<CellCorrespondences> pairs = stationPairs(reference, lidar);
  const std::vector<Vector6d> at_rest(pairs.size(), Vector6d::Zero());
  const double met = mountEquations(pairs, at_rest, {}, kFitLevel.d2).met_points;
  return {met / std::max(1.0, pointsIn(lidar)), surfaceDistance(pairs)};
}
}  // namespace scanloom
