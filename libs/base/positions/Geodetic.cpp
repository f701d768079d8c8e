#include "base/positions/Geodetic.h"

#include <mrpt/topography/conversions.h>

namespace scanloom
{
namespace
{
mrpt::topography::TGeodeticCoords toMrpt(const Geodetic& at) { return {at.latitude, at.longitude, at.height}; }
}  // namespace

Eigen::Vector3d eastNorthUp(const Geodetic& at, const Geodetic& origin)
{
  mrpt::math::TPoint3D enu;
  mrpt::topography::geodeticToENU_WGS84(toMrpt(at), enu, toMrpt(origin));
  return {enu.x, enu.y, enu.z};
}
}  // namespace scanloom
