#include "simulation/Foliage.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
/** A ray along one axis, in voxels. */
struct Axis
{
  Axis(double from, double metres_per_metre, double voxel_size)
    : origin(from / voxel_size), speed(metres_per_metre / voxel_size)
  {
    constexpr double kStill = 1e-12;  // a ray across the axis never comes to a border
    if (std::abs(speed) < kStill) speed = kStill;
    inverse = 1 / speed;
    forwards = speed > 0 ? 1 : 0;
  }

  /** Rounds down without a branch. */
  int voxelAt(double range) const
  {
    constexpr int kPositive = 1 << 21;
    return static_cast<int>(origin + range * speed + kPositive) - kPositive;
  }

  double rangeOf(int border) const { return (border - origin) * inverse; }

  double origin, speed, inverse;  // voxels, voxels per metre of ray, metres of ray per voxel
  int forwards;                   // 1, or 0 if backwards
};
}  // namespace

std::optional<Foliage::Leaf> Foliage::intersect(const Ray& ray, double max_range, double optical_depth) const
{
  const double size = voxels_.voxelSize();
  const Axis x(ray.origin.x(), ray.direction.x(), size), y(ray.origin.y(), ray.direction.y(), size),
      z(ray.origin.z(), ray.direction.z(), size);
  const double to_floor = z.rangeOf(voxels_.lowest()), to_ceiling = z.rangeOf(voxels_.above());
  double range = std::max(0.0, std::min(to_floor, to_ceiling));
  const double end = std::min(max_range, std::max(to_floor, to_ceiling));
  int at_x = x.voxelAt(range), at_y = y.voxelAt(range);
  int at_z = std::clamp(z.voxelAt(range), voxels_.lowest(), voxels_.above() - 1);

  // After J. Amanatides and A. Woo: A Fast Voxel Traversal Algorithm for Ray Tracing, Eurographics 1987; but through
  // open space in cubes as large as it is empty, and without branches that no processor foresees.
  while (range < end)
  {
    const FoliageVoxel content = voxels_.at(at_x, at_y, at_z);
    const int around = content.around();
    const auto borderOf = [&](const Axis& axis, int at) { return at - around + axis.forwards * (2 * around + 1); };
    const int border_x = borderOf(x, at_x), border_y = borderOf(y, at_y), border_z = borderOf(z, at_z);
    const double leaves_x = x.rangeOf(border_x), leaves_y = y.rangeOf(border_y), leaves_z = z.rangeOf(border_z);
    const double leaves = std::min(leaves_x, std::min(leaves_y, leaves_z));
    const double next = std::max(range, leaves);
    if (!content.isEmpty())
    {
      const double depth = content.extinction() * (std::min(next, end) - range);
      if (depth >= optical_depth) return Leaf{range + optical_depth / content.extinction(), content.surface()};
      optical_depth -= depth;
    }
    range = next;
    const auto enter = [&](const Axis& axis, int at, int border, double leaves_axis)
    {
      const int inside = std::min(std::max(axis.voxelAt(next), at - around), at + around);
      return leaves_axis == leaves ? border - 1 + axis.forwards : inside;
    };
    at_x = enter(x, at_x, border_x, leaves_x);
    at_y = enter(y, at_y, border_y, leaves_y);
    at_z = enter(z, at_z, border_z, leaves_z);
  }
  return std::nullopt;
}
}  // namespace scanloom
