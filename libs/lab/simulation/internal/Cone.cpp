#include "lab/simulation/internal/Cone.h"

#include <cmath>

namespace scanloom
{
std::optional<Cone::Entry> Cone::intersect(const Ray& ray) const
{
  const Eigen::Vector3d from_base = ray.origin - base;
  const double height = from_base.dot(axis), climb = ray.direction.dot(axis);
  const Eigen::Vector3d offset = from_base - height * axis, across = ray.direction - climb * axis;
  const double radius = base_radius + taper() * height, narrowing = taper() * climb;  // at the origin; per metre of ray
  const double c = offset.squaredNorm() - radius * radius;
  if (c < 0 && height > 0 && height < length) return std::nullopt;

  std::optional<Entry> entry;
  const auto consider = [&](double range, const Eigen::Vector3d& outwards)
  {
    if (range > 0 && (!entry || range < entry->range)) entry = Entry{range, outwards};
  };

  // |offset + t across| = radius + t narrowing
  const double a = across.squaredNorm() - narrowing * narrowing, b = across.dot(offset) - narrowing * radius;
  const double discriminant = b * b - a * c;
  if (discriminant >= 0 && a != 0)
    for (const double sign : {-1.0, 1.0})
    {
      const double range = (-b + sign * std::sqrt(discriminant)) / a, along = height + range * climb;
      if (along >= 0 && along <= length) consider(range, normal(ray.at(range)));
    }

  const auto considerEnd = [&](double along, double radius_there, const Eigen::Vector3d& outwards)
  {
    const double range = (along - height) / climb;
    if ((offset + range * across).squaredNorm() <= radius_there * radius_there) consider(range, outwards);
  };
  if (climb != 0)
  {
    considerEnd(0, base_radius, -axis);
    considerEnd(length, tip_radius, axis);
  }
  return entry;
}

Eigen::Vector3d Cone::normal(const Eigen::Vector3d& p) const
{
  const Eigen::Vector3d from_base = p - base;
  const Eigen::Vector3d outwards = (from_base - from_base.dot(axis) * axis).normalized();
  return (outwards - taper() * axis).normalized();
}
}  // namespace scanloom
