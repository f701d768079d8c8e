#include "calibration/internal/StationMaps.h"

#include "base/core/Decompositions.h"
#include "base/core/Interruption.h"
#include "base/core/Statistics.h"
#include "calibration/internal/someOf.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace scanloom
{
namespace
{
NdtOptions optionsOf(const ExtrinsicsLevel& level)
{
  NdtOptions options;
  options.cell_size = level.cell_size;
  options.min_points = level.min_points;
  return options;
}

bool isThin(const GaussianCell& cell, double thickest)
{
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(cell.covariance, Eigen::EigenvaluesOnly);
  return axes.eigenvalues()[0] <= thickest * thickest;
}

/** Without the points of thick cells, so that the map has none. */
std::vector<View> inThinCells(const std::vector<View>& views, const NdtMap& map, double thickest)
{
  std::vector<std::uint8_t> thin;
  for (const GaussianCell& cell : map.cells()) thin.push_back(isThin(cell, thickest) ? 1 : 0);
  const auto inThin = [&](const Eigen::Vector3f& point)
  {
    std::uint32_t cell = 0;
    return map.findAround(map.indexOf(point.cast<double>()), 1, &cell) == 1 && thin[cell];
  };
  std::vector<View> kept(views.size());
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    std::copy_if(views[i].points.begin(), views[i].points.end(), std::back_inserter(kept[i].points), inThin);
    kept[i].viewpoint = views[i].viewpoint;
    kept[i].corrections = views[i].corrections;
  }
  return kept;
}

NdtMap thinMap(const std::vector<View>& views, const ExtrinsicsLevel& level)
{
  const NdtMap map(views, optionsOf(level));
  if (std::isinf(level.thickest)) return map;
  return NdtMap(inThinCells(views, map, level.thickest), optionsOf(level));
}

const GaussianCell* nearestTo(const Eigen::Vector3d& mean, const CellCorrespondences& pair, std::size_t source_cell)
{
  const GaussianCell* nearest = nullptr;
  for (const std::uint32_t k : pair.of(source_cell))
  {
    const GaussianCell& cell = pair.target()[k];
    if (!nearest || (cell.mean - mean).squaredNorm() < (nearest->mean - mean).squaredNorm()) nearest = &cell;
  }
  return nearest;
}
}  // namespace

std::vector<NdtMap> mapsOfReference(const std::vector<Station>& stations, const ExtrinsicsLevel& level)
{
  std::vector<NdtMap> maps;
  for (const Station& station : stations)
  {
    throwIfInterrupted();
    maps.push_back(thinMap(station.reference, level));
  }
  return maps;
}

StationCells cellsOfLidar(const std::vector<Station>& stations, const Extrinsics& extrinsics,
                          const Trajectory& trajectory, const ExtrinsicsLevel& level)
{
  StationCells cells;
  for (const Station& station : stations)
  {
    throwIfInterrupted();
    std::vector<View> views;
    for (const LidarScan* scan : someOf(station.scans, level.scans))
      if (std::optional<View> view = viewFrom(*scan, extrinsics, trajectory, station.at, station.stems))
        views.push_back(std::move(*view));
    cells.push_back(thinMap(views, level).cells());
  }
  return cells;
}

std::vector<CellCorrespondences> stationPairs(const std::vector<NdtMap>& reference, const StationCells& lidar)
{
  constexpr int kNeighbours = 27;
  std::vector<CellCorrespondences> pairs;
  for (std::size_t i = 0; i < reference.size(); ++i)
    pairs.emplace_back(reference[i], lidar[i], reference[i].options().cell_size, kNeighbours);
  return pairs;
}

double pointsIn(const StationCells& stations)
{
  double points = 0;
  for (const std::vector<GaussianCell>& cells : stations)
    for (const GaussianCell& cell : cells) points += cell.points;
  return points;
}

double surfaceDistance(const std::vector<CellCorrespondences>& pairs)
{
  std::vector<double> distances;
  for (const CellCorrespondences& pair : pairs)
    for (std::size_t i = 0; i < pair.source().size(); ++i)
    {
      const TurnedCell& cell = pair.chunk(i / CellCorrespondences::kChunk).cells[i % CellCorrespondences::kChunk];
      const Eigen::Vector3d mean(cell.x, cell.y, cell.z);
      const GaussianCell* nearest = nearestTo(mean, pair, i);
      if (!nearest) continue;
      const Eigen::Vector3d normal = eigensystem3(nearest->covariance).vectors.col(0);
      distances.push_back(std::abs(normal.dot(nearest->mean - mean)));
    }
  return distances.empty() ? 0 : median(distances);
}
}  // namespace scanloom
