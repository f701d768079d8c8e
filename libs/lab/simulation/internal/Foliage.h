/**
 * Twigs, needles, leaves and grass as a turbid medium in voxels: a ray passes a length s of extinction k with the
 * probability exp(-k s) (Beer and Lambert).
 */
#pragma once
#include "lab/simulation/internal/FoliageVoxels.h"
#include "lab/simulation/internal/Ray.h"

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

/** A ray's way through foliage: the leaf that stops it, or none and how much of its optical depth is left. */
struct Passage
{
  std::optional<Leaf> leaf;
  double optical_depth = 0;
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
   * What becomes of each ray. With exponentially distributed optical depths each voxel returns rays with the
   * probability of Beer and Lambert.
   */
  std::vector<Passage> intersect(const std::vector<FoliageQuery>&) const;
  std::optional<Leaf> intersect(const FoliageQuery& query) const
  {
    return intersect(std::vector<FoliageQuery>{query}).front().leaf;
  }

  const FoliageVoxels& voxels() const { return voxels_; }

 private:
  FoliageVoxels voxels_;
};
}  // namespace scanloom
