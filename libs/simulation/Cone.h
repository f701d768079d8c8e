#pragma once
#include "simulation/Ray.h"

#include <optional>

namespace scanloom
{
/** A tapering piece of round wood, cut off squarely at both ends: a stem, a stump or a branch. */
struct Cone
{
  Eigen::Vector3d base;
  Eigen::Vector3d axis;    // unit, from base to tip
  double length = 0;       // m
  double base_radius = 0;  // m
  double tip_radius = 0;   // m

  Eigen::Vector3d tip() const { return base + length * axis; }

  /** What a ray needs to know of the place where it enters. */
  struct Entry
  {
    double range;            // m
    Eigen::Vector3d normal;  // unit, outwards
  };

  /** Where the ray enters; nothing from inside. */
  std::optional<Entry> intersect(const Ray&) const;

  /** Outward unit normal of the mantle next to a point. */
  Eigen::Vector3d normal(const Eigen::Vector3d&) const;

  /** Of a point to the mantle, along its normal: negative inside. */
  double distanceToMantle(const Eigen::Vector3d&) const;

 private:
  double taper() const { return (tip_radius - base_radius) / length; }
};
}  // namespace scanloom
