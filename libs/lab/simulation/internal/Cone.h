#pragma once
#include "lab/simulation/internal/Ray.h"

#include <optional>

namespace scanloom
{
/** A truncated cone with flat ends: a stem, a stump or a branch. */
struct Cone
{
  Eigen::Vector3d base;
  Eigen::Vector3d axis;    // unit, from base to tip
  double length = 0;       // m
  double base_radius = 0;  // m
  double tip_radius = 0;   // m

  Eigen::Vector3d tip() const { return base + length * axis; }

  /** Where a ray enters. */
  struct Entry
  {
    double range;            // m
    Eigen::Vector3d normal;  // unit, outwards
  };

  /** Nothing if the ray misses the cone or starts inside it. */
  std::optional<Entry> intersect(const Ray&) const;

  /** Outward unit normal of the mantle at the point next to this one. */
  Eigen::Vector3d normal(const Eigen::Vector3d&) const;

 private:
  double taper() const { return (tip_radius - base_radius) / length; }
};
}  // namespace scanloom
