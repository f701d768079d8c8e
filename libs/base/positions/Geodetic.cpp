#include "base/positions/Geodetic.h"

#include "base/core/Angle.h"
#include "base/core/ConfigError.h"

#include <fmt/format.h>
#include <proj.h>

#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
using Context = std::shared_ptr<PJ_CONTEXT>;
using Object = std::shared_ptr<PJ>;

Object owned(PJ* object) { return {object, &proj_destroy}; }

Context silentContext()
{
  Context context(proj_context_create(), &proj_context_destroy);
  proj_log_level(context.get(), PJ_LOG_NONE);  // what fails is thrown
  return context;
}

/** From longitude and latitude (rad) and height to the tangent plane. */
PJ_COORD onPlane(const Geodetic& origin, PJ_DIRECTION direction, const PJ_COORD& coordinates)
{
  const Context context = silentContext();
  const Object plane = owned(proj_create(
      context.get(), fmt::format("+proj=pipeline +step +proj=cart +ellps=WGS84 +step +proj=topocentric +ellps=WGS84 "
                                 "+lat_0={:.17g} +lon_0={:.17g} +h_0={:.17g}",
                                 origin.latitude, origin.longitude, origin.height)
                         .c_str()));
  return proj_trans(plane.get(), direction, coordinates);
}
/** Of its first axis; a compound one has its grid first. */
bool hasMetres(PJ_CONTEXT* context, PJ* system)
{
  const bool compound = proj_get_type(system) == PJ_TYPE_COMPOUND_CRS;
  const Object grid = compound ? owned(proj_crs_get_sub_crs(context, system, 0)) : owned(proj_clone(context, system));
  const Object axes = owned(proj_crs_get_coordinate_system(context, grid.get()));
  const char* unit = nullptr;
  return axes &&
         proj_cs_get_axis_info(context, axes.get(), 0, nullptr, nullptr, nullptr, nullptr, &unit, nullptr, nullptr) !=
             0 &&
         std::string(unit) == "metre";
}
}  // namespace

Eigen::Vector3d eastNorthUp(const Geodetic& at, const Geodetic& origin)
{
  const PJ_COORD enu = onPlane(origin, PJ_FWD, proj_coord(at.longitude * kDegree, at.latitude * kDegree, at.height, 0));
  return {enu.xyz.x, enu.xyz.y, enu.xyz.z};
}

Geodetic geodeticOf(const Eigen::Vector3d& enu, const Geodetic& origin)
{
  const PJ_COORD at = onPlane(origin, PJ_INV, proj_coord(enu.x(), enu.y(), enu.z(), 0));
  return {at.lpz.phi / kDegree, at.lpz.lam / kDegree, at.lpz.z};
}

struct CountryGrid::Proj
{
  Context context = silentContext();
  Object grid, from_geodetic;
};

CountryGrid::CountryGrid(const std::string& name) : proj_(std::make_unique<Proj>())
{
  PJ_CONTEXT* context = proj_->context.get();
  const Object wgs84 = owned(proj_create(context, "EPSG:4979"));
  const Object& grid = proj_->grid = owned(proj_create(context, name.c_str()));
  if (!grid || !proj_is_crs(grid.get()))
    throw UsageError(fmt::format("--crs {}: PROJ knows no such coordinate reference system", name));
  if (!hasMetres(context, grid.get()))
    throw UsageError(fmt::format("--crs {}: its coordinates are no metres: give a grid that has them", name));
  const char* const options[] = {"ALLOW_BALLPARK=NO", nullptr};
  const Object transformation =
      owned(proj_create_crs_to_crs_from_pj(context, wgs84.get(), grid.get(), nullptr, options));
  if (transformation) proj_->from_geodetic = owned(proj_normalize_for_visualization(context, transformation.get()));
  if (!proj_->from_geodetic)
    throw UsageError(
        fmt::format("--crs {}: there is no exact way to it; heights above the sea need a file of PROJ "
                    "that is not installed",
                    name));
  const char* const wkt = proj_as_wkt(context, grid.get(), PJ_WKT1_GDAL, nullptr);
  if (!wkt) throw UsageError(fmt::format("--crs {}: LAS files cannot name it", name));
  wkt_ = wkt;
}

CountryGrid::~CountryGrid() = default;
CountryGrid::CountryGrid(CountryGrid&&) noexcept = default;

Eigen::Vector3d CountryGrid::of(const Geodetic& at) const
{
  const PJ_COORD found =
      proj_trans(proj_->from_geodetic.get(), PJ_FWD, proj_coord(at.longitude, at.latitude, at.height, 0));
  if (!std::isfinite(found.xyz.x) || !std::isfinite(found.xyz.y))
    throw std::runtime_error(fmt::format(
        "latitude {}, longitude {}: the coordinate reference system does not reach there", at.latitude, at.longitude));
  return {found.xyz.x, found.xyz.y, found.xyz.z};
}

bool CountryGrid::reaches(const Eigen::Vector3d& at) const
{
  double west = 0, south = 0, east = 0, north = 0;
  if (proj_get_area_of_use(proj_->context.get(), proj_->grid.get(), &west, &south, &east, &north, nullptr) == 0 ||
      west < -180)
    return true;
  const PJ_COORD found = proj_trans(proj_->from_geodetic.get(), PJ_INV, proj_coord(at.x(), at.y(), at.z(), 0));
  const double longitude = found.lpz.lam, latitude = found.lpz.phi;
  const bool between = west <= east ? longitude >= west && longitude <= east : longitude >= west || longitude <= east;
  return between && latitude >= south && latitude <= north;
}
}  // namespace scanloom
