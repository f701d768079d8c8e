#pragma once
#include "lab/simulation/internal/Cone.h"

#include <cmath>

namespace scanloom
{
/** Distance of a point from the cone's mantle, along its normal: negative inside. m */
inline double distanceToMantle(const Cone& cone, const Eigen::Vector3d& p)
{
  const double taper = (cone.tip_radius - cone.base_radius) / cone.length;
  const Eigen::Vector3d from_base = p - cone.base;
  const double height = from_base.dot(cone.axis);
  const double beside = (from_base - height * cone.axis).norm() - (cone.base_radius + taper * height);
  return beside / std::sqrt(1 + taper * taper);
}
}  // namespace scanloom
