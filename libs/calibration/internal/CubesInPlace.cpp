#include "calibration/internal/CubesInPlace.h"

#include "base/core/VoxelKey.h"

namespace scanloom
{
void CubesInPlace::add(const std::vector<Eigen::Vector3f>& cloud)
{
  for (const Eigen::Vector3f& p : cloud)
  {
    Cube& cube = cubes_[voxelKey(p, edge_)];
    if (cube.last != clouds_) ++cube.clouds;
    cube.last = clouds_;
  }
  ++clouds_;
}

int CubesInPlace::cloudsAt(const Eigen::Vector3f& p) const
{
  const auto cube = cubes_.find(voxelKey(p, edge_));
  return cube == cubes_.end() ? 0 : cube->second.clouds;
}
}  // namespace scanloom
