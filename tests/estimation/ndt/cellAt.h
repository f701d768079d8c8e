#pragma once
#include "estimation/ndt/NdtMap.h"

namespace scanloom
{
/** The Gaussian of a cell; nullptr where there is none. */
inline const GaussianCell* cellAt(const NdtMap& map, const Eigen::Vector3i& index)
{
  std::uint32_t found;
  return map.findAround(index, 1, &found) == 0 ? nullptr : &map.cells()[found];
}
}  // namespace scanloom
