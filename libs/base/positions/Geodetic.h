/** Places on the earth (WGS84), and in the coordinates of a country. */
#pragma once
#include <Eigen/Core>

#include <memory>
#include <string>

namespace scanloom
{
struct Geodetic
{
  double latitude = 0, longitude = 0;  // deg
  double height = 0;                   // m, above the ellipsoid
};

/** m, east, north and up (normal to the ellipsoid) of the origin. */
Eigen::Vector3d eastNorthUp(const Geodetic&, const Geodetic& origin);

/** Where that is. */
Geodetic geodeticOf(const Eigen::Vector3d& east_north_up, const Geodetic& origin);

/** Coordinates of a country, by PROJ: EPSG:3067, or what else PROJ understands. */
class CountryGrid
{
 public:
  /**
   * Throws UsageError if PROJ does not know it, if it is no grid in metres, and if the way there needs a file, as of
   * heights above the sea, that is not installed: PROJ would leave that step out.
   */
  explicit CountryGrid(const std::string& name);
  ~CountryGrid();
  CountryGrid(CountryGrid&&) noexcept;

  /** East, north and height, m. Throws std::runtime_error where the grid does not reach. */
  Eigen::Vector3d of(const Geodetic&) const;

  /** Whether these coordinates are in the area for which the grid is made; true where PROJ does not know it. */
  bool reaches(const Eigen::Vector3d& east_north_height) const;

  /** As LAS files name it: WKT of OGC 01-009. */
  const std::string& wkt() const { return wkt_; }

 private:
  struct Proj;
  std::unique_ptr<Proj> proj_;
  std::string wkt_;
};
}  // namespace scanloom
