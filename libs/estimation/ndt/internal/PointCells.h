/** The cell of each point of a batch, and its place in the cell. */
#pragma once
#include "base/core/Kernel.h"
#include "estimation/ndt/internal/CellBins.h"

#include <cstddef>
#include <cstdint>

namespace scanloom
{
struct PointCells
{
  static constexpr std::size_t kPoints = 512;
  static constexpr std::uint64_t kNowhere = ~std::uint64_t{0};  // the key of no cell

  /** From the corner of a cell, in quanta. */
  static constexpr std::int64_t centreOf(std::int64_t cell_quanta) { return cell_quanta / 2; }

  alignas(64) double x[kPoints], y[kPoints], z[kPoints];  // whole quanta from the cell's centre
  alignas(64) std::uint64_t key[kPoints];                 // kNowhere: not finite, or too far for an index
};

/**
 * At most kPoints points, which `grid_R_points` turns into the frame of the grid; places after them are undefined. The
 * bits are the same for every kernel.
 */
PointCells locate(const Coordinates&, std::int64_t cell_quanta, const Eigen::Matrix3d& grid_R_points,
                  Kernel = widestKernel());
}  // namespace scanloom
