/**
 * Twigs, needles, leaves and grass: a turbid medium in voxels. Light that passes a voxel of extinction k over a length
 * s gets through with the chance exp(-k s) (Beer and Lambert).
 */
#pragma once
#include "simulation/FoliageVoxels.h"
#include "simulation/Ray.h"

#include <optional>
#include <utility>
#include <vector>

namespace scanloom
{
struct Leaf
{
  double range;  // m
  Surface surface;
};

struct FoliageQuery
{
  Ray ray;
  double max_range;      // m
  double optical_depth;  // of the foliage that the ray gets through
};

class Foliage
{
 public:
  explicit Foliage(FoliageVoxels voxels) : voxels_(std::move(voxels)) { voxels_.measureOpenSpace(); }

  /**
   * Where each ray has passed so much foliage that the integral of its extinction reaches `optical_depth`. An
   * exponentially distributed depth gives every voxel the chance of a return that its extinction asks for.
   */
  std::vector<std::optional<Leaf>> intersect(const std::vector<FoliageQuery>&) const;
  std::optional<Leaf> intersect(const FoliageQuery& query) const
  {
    return intersect(std::vector<FoliageQuery>{query}).front();
  }

  const FoliageVoxels& voxels() const { return voxels_; }

 private:
  FoliageVoxels voxels_;
};
}  // namespace scanloom
