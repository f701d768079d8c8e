/**
 * Twigs, needles, leaves and grass as a turbid medium in voxels: a ray passes a length s of extinction k with the
 * probability exp(-k s) (Beer and Lambert).
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
  double optical_depth;  // the ray is stopped where the integral of the extinction reaches this
};

class Foliage
{
 public:
  explicit Foliage(FoliageVoxels voxels) : voxels_(std::move(voxels)) { voxels_.measureOpenSpace(); }

  /**
   * The leaf that stops each ray; nothing if the ray passes. With exponentially distributed optical depths each voxel
   * returns rays with the probability of Beer and Lambert.
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
