#include "lab/simulation/internal/Foliage.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scanloom
{
namespace
{
/** x, y, z and an unused lane: one instruction for three axes on every 64-bit processor. */
using Axes = float __attribute__((vector_size(16)));
using AxesInt = int __attribute__((vector_size(16)));

Axes same(float value) { return Axes{value, value, value, value}; }

/** To the nearest whole number; halves go to either side. */
Axes rounded(Axes value)
{
  constexpr float kWhole = 0x1.8p23F;  // adding and subtracting it leaves no bits for a fraction
  return (value + kWhole) - kWhole;
}

Axes clamped(Axes value, Axes least, Axes most)
{
  value = value < least ? least : value;
  return value > most ? most : value;
}

/**
 * A ray that goes from voxel to voxel. Coordinates count voxels from the one that it starts in, so that floats are
 * exact to 10 um at 100 m. After J. Amanatides and A. Woo: A Fast Voxel Traversal Algorithm for Ray Tracing,
 * Eurographics 1987; but empty space is crossed in cubes as large as it is empty, and without branches that are hard to
 * predict.
 */
class Walk
{
 public:
  Walk() = default;
  Walk(const FoliageVoxels& voxels, const FoliageQuery& query) : optical_depth_(static_cast<float>(query.optical_depth))
  {
    const Ray& ray = query.ray;
    const double size = voxels.voxelSize();
    const Eigen::Array3i start = voxels.voxelAt(ray.origin);
    constexpr double kStill = 1e-12;  // a ray at a right angle to an axis never crosses a border of it
    for (int i = 0; i < 3; ++i)
    {
      const double speed = std::abs(ray.direction[i]) < kStill ? kStill : ray.direction[i];
      start_[i] = start[i];
      origin_[i] = static_cast<float>(ray.origin[i] / size - start[i]);
      speed_[i] = static_cast<float>(speed / size);
      inverse_[i] = static_cast<float>(size / speed);
      sign_[i] = speed > 0 ? 1 : -1;
      forwards_[i] = speed > 0 ? 1 : 0;
    }
    const float lowest = static_cast<float>(voxels.lowest() - start.z()),
                above = static_cast<float>(voxels.above() - start.z());
    const float to_floor = (lowest - origin_[2]) * inverse_[2], to_ceiling = (above - origin_[2]) * inverse_[2];
    range_ = std::max(0.0F, std::min(to_floor, to_ceiling));
    end_ = std::min(static_cast<float>(query.max_range), std::max(to_floor, to_ceiling));
    at_ = voxelAt(range_);
    at_[2] = std::clamp(at_[2], lowest, above - 1);
  }

  bool hasEnded() const { return range_ >= end_; }
  const std::optional<Leaf>& leaf() const { return leaf_; }
  double opticalDepth() const { return optical_depth_; }  // that is left

  void step(const FoliageVoxels& voxels)
  {
    const AxesInt voxel = start_ + __builtin_convertvector(at_, AxesInt);
    const FoliageVoxel content = voxels.at(voxel[0], voxel[1], voxel[2]);
    const Axes around = same(static_cast<float>(content.around()));
    const Axes leaves = (at_ + sign_ * around + forwards_ - origin_) * inverse_;
    const float first = std::min(leaves[0], std::min(leaves[1], leaves[2]));
    const float next = std::max(range_, first);
    if (!content.isEmpty())
    {
      const float extinction = static_cast<float>(content.extinction());
      const float depth = extinction * (std::min(next, end_) - range_);
      if (depth >= optical_depth_)
      {
        leaf_ = Leaf{range_ + optical_depth_ / extinction, content.surface()};
        range_ = end_;
        return;
      }
      optical_depth_ -= depth;
    }
    range_ = next;
    const Axes inside = clamped(voxelAt(next), at_ - around, at_ + around);
    at_ = leaves == same(first) ? at_ + sign_ * (around + 1) : inside;
  }

 private:
  Axes voxelAt(float range) const { return rounded(origin_ + same(range) * speed_ - 0.5F); }

  AxesInt start_{};                      // voxel of the ray's origin
  Axes origin_{}, speed_{}, inverse_{};  // voxels from there, voxels per metre of ray, metres of ray per voxel
  Axes sign_{}, forwards_{};             // 1 and 1, or -1 and 0
  Axes at_{};                            // voxels from that of the origin
  float range_ = 0, end_ = 0, optical_depth_ = 0;
  std::optional<Leaf> leaf_;
};
}  // namespace

std::vector<Passage> Foliage::intersect(const std::vector<FoliageQuery>& queries) const
{
  std::vector<Passage> passages(queries.size());
  struct Slot
  {
    Walk walk;
    std::size_t query = 0;
  };
  // Several rays take their steps in turn: the steps of one depend on each other, those of several overlap.
  constexpr std::size_t kAtOnce = 4;
  std::array<Slot, kAtOnce> slots;
  std::size_t active = 0, next = 0;
  const auto start = [&] { return Slot{Walk(voxels_, queries[next]), next++}; };
  while (active < kAtOnce && next < queries.size()) slots[active++] = start();
  while (active > 0)
    for (std::size_t i = 0; i < active; ++i)
    {
      Slot& slot = slots[i];
      if (!slot.walk.hasEnded())
      {
        slot.walk.step(voxels_);
        continue;
      }
      passages[slot.query] = {slot.walk.leaf(), slot.walk.opticalDepth()};
      slot = next < queries.size() ? start() : slots[--active];
    }
  return passages;
}
}  // namespace scanloom
