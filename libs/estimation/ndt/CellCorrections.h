/** How the cells that a lidar sees are corrected for the side from which it sees what fills them. */
#pragma once
#include "estimation/ndt/internal/CellBins.h"

#include <Eigen/Core>

#include <vector>

namespace scanloom
{
/** From where the cells of a grid were seen, in the grid's frame. */
struct Sight
{
  double edge;  // m, of a cell
  Eigen::Vector3d viewpoint;
  Eigen::Vector3d up;  // roughly
  int least_points;    // that tell the covariance of a cell
};

/**
 * Registration knows nothing of what stands in a place: what is known of it is handed in with each View, as functions
 * of its cells. Without any, cells are as they were seen.
 */
struct CellCorrections
{
  /** First, of all cells together. */
  std::vector<Bin> (*of_all)(std::vector<Bin>, const Sight&) = nullptr;

  /** Then, by how much the points of each cell of `least_points` are moved, m. */
  Eigen::Vector3d (*shift_of)(const MeanAndCovariance&, const Sight&) = nullptr;
};
}  // namespace scanloom
