#include "lab/simulation/internal/Solids.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scanloom
{
namespace
{
/** Whether a ray cannot meet anything inside the sphere: it passes beside it, or the sphere is behind. */
bool misses(const Ray& ray, const Eigen::Vector3d& centre, double radius)
{
  const Eigen::Vector3d to_centre = centre - ray.origin;
  const double along = to_centre.dot(ray.direction);
  return along < -radius || to_centre.squaredNorm() - along * along > radius * radius;
}
}  // namespace

std::optional<Contact> castBox(const Eigen::AlignedBox3d& box, const Ray& ray)
{
  // The slab method.
  double entered = 0, left = std::numeric_limits<double>::infinity();
  int entered_through = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double to_min = (box.min()[axis] - ray.origin[axis]) / ray.direction[axis];
    const double to_max = (box.max()[axis] - ray.origin[axis]) / ray.direction[axis];
    if (std::min(to_min, to_max) > entered)
    {
      entered = std::min(to_min, to_max);
      entered_through = axis;
    }
    left = std::min(left, std::max(to_min, to_max));
  }
  if (entered <= 0 || entered >= left) return std::nullopt;
  return Contact{entered, std::abs(ray.direction[entered_through])};
}

OrientedBox::OrientedBox(const Rigid& frame_T_box, const Eigen::Vector3d& half)
  : frame_T_box_(frame_T_box), box_R_frame_(frame_T_box.rotation.conjugate().toRotationMatrix()), half_(half)
{
}

std::optional<Contact> OrientedBox::cast(const Ray& ray) const
{
  if (misses(ray, frame_T_box_.translation, half_.norm())) return std::nullopt;
  const Ray in_box{box_R_frame_ * (ray.origin - frame_T_box_.translation), box_R_frame_ * ray.direction};
  return castBox({-half_, half_}, in_box);
}

std::optional<Contact> castCone(const Cone& cone, const Ray& ray)
{
  const Eigen::Vector3d middle = 0.5 * (cone.base + cone.tip());
  if (misses(ray, middle, std::hypot(0.5 * cone.length, std::max(cone.base_radius, cone.tip_radius))))
    return std::nullopt;
  const auto entry = cone.intersect(ray);
  if (!entry) return std::nullopt;
  return Contact{entry->range, std::abs(entry->normal.dot(ray.direction))};
}
}  // namespace scanloom
