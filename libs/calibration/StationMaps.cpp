#include "calibration/StationMaps.h"

#include "core/Statistics.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
NdtOptions optionsOf(const MountLevel& level)
{
  NdtOptions options;
  options.cell_size = level.cell_size;
  options.min_points = level.min_points;
  return options;
}

std::vector<GaussianCell> thinCells(const NdtMap& map, double thickest)
{
  if (std::isinf(thickest)) return map.cells();
  std::vector<GaussianCell> thin;
  for (const GaussianCell& cell : map.cells())
  {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
    axes.computeDirect(cell.covariance, Eigen::EigenvaluesOnly);
    if (axes.eigenvalues()[0] <= thickest * thickest) thin.push_back(cell);
  }
  return thin;
}

const GaussianCell* nearestTo(const Eigen::Vector3d& mean, const Neighbourhoods& pair, std::size_t source_cell)
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

std::vector<NdtMap> mapsOfReference(const std::vector<Station>& stations, const MountLevel& level)
{
  std::vector<NdtMap> maps;
  for (const Station& station : stations) maps.emplace_back(station.reference, optionsOf(level));
  return maps;
}

StationCells cellsOfLidar(const std::vector<Station>& stations, const Mount& mount, const Trajectory& trajectory,
                          const MountLevel& level)
{
  StationCells cells;
  for (const Station& station : stations)
  {
    std::vector<View> views;
    for (std::size_t i = 0; i < std::min(level.scans, station.scans.size()); ++i)
      if (std::optional<View> view = viewFrom(*station.scans[i], mount, trajectory, station.at))
        views.push_back(std::move(*view));
    cells.push_back(thinCells(NdtMap(views, optionsOf(level)), level.thickest));
  }
  return cells;
}

std::vector<Neighbourhoods> stationPairs(const std::vector<NdtMap>& reference, const StationCells& lidar)
{
  constexpr int kNeighbours = 27;
  std::vector<Neighbourhoods> pairs;
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

double surfaceDistance(const std::vector<Neighbourhoods>& pairs)
{
  std::vector<double> distances;
  for (const Neighbourhoods& pair : pairs)
    for (std::size_t i = 0; i < pair.source().size(); ++i)
    {
      const TurnedCell& cell = pair.chunk(i / Neighbourhoods::kChunk).cells[i % Neighbourhoods::kChunk];
      const Eigen::Vector3d mean(cell.x, cell.y, cell.z);
      const GaussianCell* nearest = nearestTo(mean, pair, i);
      if (!nearest) continue;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(nearest->covariance);
      distances.push_back(std::abs(axes.eigenvectors().col(0).dot(nearest->mean - mean)));
    }
  return distances.empty() ? 0 : median(distances);
}
}  // namespace scanloom
