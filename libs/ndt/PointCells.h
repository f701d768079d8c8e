/** In which cell each of a batch of points lies, and where in it. */
#pragma once
#include "core/Kernel.h"
#include "ndt/CellBins.h"

#include <cstddef>
#include <cstdint>

namespace scanloom
{
struct PointCells
{
  static constexpr std::size_t kPoints = 512;
  static constexpr std::uint64_t kNowhere = ~std::uint64_t{0};  // the key of no cell

  /** Of a cell, from its corner, in quanta. */
  static constexpr std::int64_t centreOf(std::int64_t cell_quanta) { return cell_quanta / 2; }

  alignas(64) double x[kPoints], y[kPoints], z[kPoints];  // whole quanta from the cell's centre
  alignas(64) std::uint64_t key[kPoints];                 // kNowhere: not finite, or too far for an index
};

/** Of at most kPoints points; places after them are left undefined. Equal to the bit for every kernel. */
void locate(const Coordinates&, std::int64_t cell_quanta, PointCells&, Kernel = widestKernel());
}  // namespace scanloom
