/** NDT cells of stations, and the pairs that are registered. */
#pragma once
#include "calibration/internal/Stations.h"
#include "estimation/ndt/CellCorrespondences.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace scanloom
{
/** Cells of one size (m), the width of the score with them (RegistrationOptions::d2), and which are used. */
struct ExtrinsicsLevel
{
  double cell_size, d2;
  /** At most so many scans of the lidar that is calibrated, evenly chosen: few are enough for a start, and quick. */
  std::size_t scans = std::numeric_limits<std::size_t>::max();
  int min_points = 4;
  /** Cells of either lidar that are thicker (standard deviation, m) are left out. */
  double thickest = std::numeric_limits<double>::infinity();
};

/**
 * Of the estimate. Each lidar sees the near side of bushes and crowns: cells full of leaves pull by 1 cm and 0.1 deg in
 * a dense stand. Of cells of 2 or 3 points the covariance is assumed, and thin enough.
 */
constexpr ExtrinsicsLevel kFinestLevel{1.0, 1.0, std::numeric_limits<std::size_t>::max(), 2, 0.06};

/** By station. */
std::vector<NdtMap> mapsOfReference(const std::vector<Station>&, const ExtrinsicsLevel&);

using StationCells = std::vector<std::vector<GaussianCell>>;
StationCells cellsOfLidar(const std::vector<Station>&, const Extrinsics&, const Trajectory&, const ExtrinsicsLevel&);

/** Keeps references to both, which are of the same level. */
std::vector<CellCorrespondences> stationPairs(const std::vector<NdtMap>& reference, const StationCells& lidar);

double pointsIn(const StationCells&);

/**
 * Median over the cells of the distance to the nearest cell of the reference, along that one's normal (m); 0 if there
 * is none. The pairs must have been moved to the extrinsics.
 */
double surfaceDistance(const std::vector<CellCorrespondences>&);
}  // namespace scanloom
