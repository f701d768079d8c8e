/** NDT cells of stations, and the pairs that are registered. */
#pragma once
#include "calibration/Stations.h"
#include "ndt/Neighbourhoods.h"

#include <vector>

namespace scanloom
{
/** Cells of one size (m), and the width of the score with them (RegistrationOptions::d2). */
struct MountLevel
{
  double cell_size, d2;
};

/** By station. */
std::vector<NdtMap> mapsOfReference(const std::vector<Station>&, const MountLevel&);
std::vector<NdtMap> mapsOfLidar(const std::vector<Station>&, const Mount&, const Trajectory&, const MountLevel&);

/** Keeps references to both. */
std::vector<Neighbourhoods> stationPairs(const std::vector<NdtMap>& reference, const std::vector<NdtMap>& lidar);

/** Points in cells that have a Gaussian. */
double pointsInCells(const std::vector<NdtMap>&);

/**
 * Median over the cells of the distance to the nearest cell of the reference, along that one's normal (m); 0 if there
 * is none. The pairs must have been moved to the mount.
 */
double surfaceDistance(const std::vector<Neighbourhoods>&);
}  // namespace scanloom
