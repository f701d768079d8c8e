#include "calibration/internal/ExtrinsicsFit.h"

#include "calibration/internal/ExtrinsicsEquations.h"

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr ExtrinsicsLevel kFitLevel{1.0, 1.0};

/** The station with the views of the reference from `first` on, every second one. */
Station halfOf(const Station& station, std::size_t first)
{
  Station half{station.at, {}, {}, station.twist, station.stems};
  for (std::size_t i = first; i < station.reference.size(); i += 2) half.reference.push_back(station.reference[i]);
  return half;
}
}  // namespace

ExtrinsicsFit extrinsicsFit(const std::vector<Station>& stations, const Extrinsics& extrinsics,
                            const Trajectory& trajectory)
{
  const std::vector<NdtMap> reference = mapsOfReference(stations, kFitLevel);
  const StationCells lidar = cellsOfLidar(stations, extrinsics, trajectory, kFitLevel);
  std::vector<CellCorrespondences> pairs = stationPairs(reference, lidar);
  const std::vector<Vector6d> at_rest(pairs.size(), Vector6d::Zero());
  const double met = extrinsicsEquations(pairs, at_rest, {}, kFitLevel.d2).met_points;
  return {met / std::max(1.0, pointsIn(lidar)), surfaceDistance(pairs)};
}

bool fitsAsWell(const ExtrinsicsFit& other, const ExtrinsicsFit& best)
{
  return other.shared > 0.8 * best.shared && other.distance < 1.5 * best.distance;
}

double distanceWithinReference(const std::vector<Station>& stations)
{
  std::vector<Station> even, odd;
  for (const Station& station : stations) even.push_back(halfOf(station, 0)), odd.push_back(halfOf(station, 1));
  const std::vector<NdtMap> maps = mapsOfReference(even, kFitLevel);
  StationCells cells;
  for (const NdtMap& map : mapsOfReference(odd, kFitLevel)) cells.push_back(map.cells());
  std::vector<CellCorrespondences> pairs = stationPairs(maps, cells);
  extrinsicsEquations(pairs, std::vector<Vector6d>(pairs.size(), Vector6d::Zero()), {}, kFitLevel.d2);
  return surfaceDistance(pairs);
}
}  // namespace scanloom
