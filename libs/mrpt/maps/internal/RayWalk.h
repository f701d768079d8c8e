/** The voxels of a ray: J. Amanatides, A. Woo: A Fast Voxel Traversal Algorithm for Ray Tracing, Eurographics 1987. */
#pragma once
#include "mrpt/maps/internal/Morton.h"

#include <octomap/OcTree.h>

#include <array>
#include <cmath>
#include <limits>

namespace scanloom
{
/**
 * Steps from voxel to voxel in Morton codes. Meets the same voxels as OcTree::computeRayKeys(), because it computes in
 * the same order and precision: floats for directions, doubles for borders.
 */
class RayWalk
{
 public:
  RayWalk(const octomap::OcTree& tree, const octomap::point3d& origin, const octomap::OcTreeKey& origin_key,
          const octomap::point3d& end)
  {
    octomap::point3d direction = end - origin;
    length_ = static_cast<float>(direction.norm());
    direction /= length_;
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      const MortonCode one = MortonCode{1} << axis;
      mask_[axis] = kEveryThirdBit << axis;
      place_[axis] = spread(origin_key[axis]) << axis;
      if (direction(axis) == 0.0F) continue;

      const int sign = direction(axis) > 0.0F ? 1 : -1;
      // The bits of the other axes are set, so that a carry passes over them to the next bit of this axis.
      step_[axis] = sign > 0 ? one + ~mask_[axis] : MortonCode{0} - one;
      double border = tree.keyToCoord(origin_key[axis]);
      border += static_cast<float>(sign * tree.getResolution() * 0.5);
      next_[axis] = (border - origin(axis)) / direction(axis);
      spacing_[axis] = tree.getResolution() / std::fabs(direction(axis));
    }
    axis_ = nearest();
  }

  MortonCode voxel() const { return place_[0] | place_[1] | place_[2]; }

  void advance()
  {
    place_[axis_] = (place_[axis_] + step_[axis_]) & mask_[axis_];
    next_[axis_] += spacing_[axis_];
    axis_ = nearest();
  }

  /** Because of rounding a ray may miss the voxel of its end. */
  bool isPastTheEnd() const { return next_[axis_] > length_; }

 private:
  std::size_t nearest() const
  {
    if (next_[0] < next_[1]) return next_[0] < next_[2] ? 0 : 2;
    return next_[1] < next_[2] ? 1 : 2;
  }

  static constexpr double kNever = std::numeric_limits<double>::max();

  std::array<MortonCode, 3> place_{}, mask_{}, step_{};
  std::array<double, 3> next_{kNever, kNever, kNever}, spacing_{kNever, kNever, kNever};  // m along the ray
  float length_;
  std::size_t axis_;  // that is crossed next
};

/** Visits the codes from the origin's voxel to the one before the end's; none if both are the same. */
template <typename Visitor>
void forEachVoxelBefore(const octomap::OcTree& tree, const octomap::point3d& origin, const octomap::point3d& end,
                        Visitor&& visit)
{
  octomap::OcTreeKey origin_key, end_key;
  if (!tree.coordToKeyChecked(origin, origin_key) || !tree.coordToKeyChecked(end, end_key)) return;
  const MortonCode last = codeOf(end_key);
  RayWalk walk(tree, origin, origin_key, end);
  if (walk.voxel() == last) return;
  visit(walk.voxel());
  for (walk.advance(); walk.voxel() != last && !walk.isPastTheEnd(); walk.advance()) visit(walk.voxel());
}
}  // namespace scanloom
