/** Places on the earth (WGS84). */
#pragma once
#include <Eigen/Core>

namespace scanloom
{
struct Geodetic
{
  double latitude = 0, longitude = 0;  // deg
  double height = 0;                   // m, above the ellipsoid
};

/** m, east, north and up (normal to the ellipsoid) of the origin. */
Eigen::Vector3d eastNorthUp(const Geodetic&, const Geodetic& origin);
}  // namespace scanloom
