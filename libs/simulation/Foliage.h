/**
 * Twigs, needles, leaves and grass: a turbid medium in voxels. Light that passes a voxel of extinction k over a length
 * s gets through with the chance exp(-k s) (Beer and Lambert).
 */
#pragma once
#include "simulation/FoliageVoxels.h"
#include "simulation/Ray.h"

#include <optional>
#include <utility>

namespace scanloom
{
class Foliage
{
 public:
  explicit Foliage(FoliageVoxels voxels) : voxels_(std::move(voxels)) { voxels_.measureOpenSpace(); }

  struct Leaf
  {
    double range;  // m
    Surface surface;
  };

  /**
   * Where the ray has passed so much foliage that the integral of its extinction reaches `optical_depth`. An
   * exponentially distributed depth gives every voxel the chance of a return that its extinction asks for.
   */
  std::optional<Leaf> intersect(const Ray&, double max_range, double optical_depth) const;

  const FoliageVoxels& voxels() const { return voxels_; }

 private:
  FoliageVoxels voxels_;
};
}  // namespace scanloom
