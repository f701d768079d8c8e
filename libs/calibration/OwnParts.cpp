#include "calibration/OwnParts.h"

#include "base/core/VoxelKey.h"

#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kPartCube = 0.25, kFarFromGround = 0.4;  // m
constexpr double kAlmostAlways = 0.75;                    // of the places
}  // namespace

void OwnParts::addPlace(const PointCloud& points)
{
  ++places_;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    Cube& cube = cubes_[voxelKey(points.position(i), kPartCube)];
    if (cube.last != places_) ++cube.places;
    cube.last = places_;
  }
}

bool OwnParts::mayHold(const Eigen::Vector3f& p) const
{
  return p.norm() <= reach_ && !(ground_ && std::abs(ground_->heightOf(p.cast<double>())) < kFarFromGround);
}

double OwnParts::shareOfPlaces(const Eigen::Vector3f& p) const
{
  const auto cube = cubes_.find(voxelKey(p, kPartCube));
  return cube == cubes_.end() ? 0 : static_cast<double>(cube->second.places) / places_;
}

bool OwnParts::holds(const Eigen::Vector3f& p) const { return mayHold(p) && shareOfPlaces(p) >= kAlmostAlways; }
}  // namespace scanloom
