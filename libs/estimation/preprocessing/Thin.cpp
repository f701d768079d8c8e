#include "estimation/preprocessing/Thin.h"

#include "base/core/VoxelKey.h"

#include <stdexcept>
#include <unordered_set>

namespace scanloom
{
PointCloud thin(PointCloud points, double edge)
{
  if (!(edge > 0)) throw std::invalid_argument("thin: the edge must be positive");
  std::unordered_set<std::uint64_t> taken;  // only asked, never iterated
  taken.reserve(points.size());
  std::vector<std::uint8_t> keep(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    keep[i] = points.position(i).allFinite() && taken.insert(voxelKey(points.position(i), edge)).second;
  points.keep(keep);
  return points;
}
}  // namespace scanloom
