#include "simulation/Machine.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scanloom
{
namespace
{
/** The slab method: distance to a box from outside. */
std::optional<Hit> castBox(const Eigen::AlignedBox3d& box, const Ray& ray)
{
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
  return Hit{entered, std::abs(ray.direction[entered_through]), Surface::Machine, 0};
}
}  // namespace

const std::vector<Eigen::AlignedBox3d>& machineBoxes()
{
  static const std::vector<Eigen::AlignedBox3d> boxes{
      {Eigen::Vector3d(-3.5, -1.1, 0.6), Eigen::Vector3d(0.8, 1.1, 2.6)},
      {Eigen::Vector3d(0.8, -0.25, 1.6), Eigen::Vector3d(4.5, 0.25, 2.1)},
  };
  return boxes;
}

std::optional<Hit> castMachine(const Rigid& world_T_body, const Ray& ray)
{
  const Eigen::Quaterniond body_R_world = world_T_body.rotation.conjugate();
  const Ray in_body{body_R_world * (ray.origin - world_T_body.translation), body_R_world * ray.direction};
  std::optional<Hit> nearest;
  for (const Eigen::AlignedBox3d& box : machineBoxes())
    if (const auto hit = castBox(box, in_body); hit && (!nearest || hit->range < nearest->range)) nearest = hit;
  return nearest;
}
}  // namespace scanloom
