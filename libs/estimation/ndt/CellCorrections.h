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
  int least_points;    // a cell with fewer has no known covariance
};

/**
 * Registration knows nothing of trees or walls. What is known of the scene is handed in with each View, as functions of
 * its cells. Without them, cells are as the lidar saw them.
 */
struct CellCorrections
{
  /** Applied first, to all cells together. */
  std::vector<Bin> (*of_all)(std::vector<Bin>, const Sight&) = nullptr;

  /** Applied then: the shift (m) of the points of each cell that has `least_points`. */
  Eigen::Vector3d (*shift_of)(const MeanAndCovariance&, const Sight&) = nullptr;
};
}  // namespace scanloom
