/**
 * The files of a site:
 *   keyframes.simplemap   the largest piece, for `slam --map`, `map` and MRPT's tools; poses with their covariances
 *   pieces/N.simplemap    the others, from 2 on
 *   drives/NAME.tum       the poses of each drive, in the frame of its piece
 *   loops.csv             every pair of keyframes that was searched, and whether it is believed
 *   references.csv        every position of a reference during a drive, and what is left of it
 *   tiles/X_Y.bt          the largest piece as occupancy in squares of 51.2 m, whose corner is at X, Y times that
 *   tiles/X_Y.las         with a grid: their points in its coordinates
 *   gone.csv              what earlier drives saw and later ones saw through: it is in none of the maps above
 *   site.png              the largest piece from above, with drives and loops
 *   site.json             drives, pieces, tiles, counts
 */
#pragma once
#include "base/positions/Geodetic.h"
#include "site/GoneThing.h"
#include "site/Site.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** All names that writeSite() uses in the folder, site.json last. */
std::vector<std::string> siteFiles();

/** Names of the drives, made different by their parents' names or numbers where folders have the same name. */
std::vector<std::string> namesOf(const std::vector<SiteDrive>&);

/** Pieces of a drive, in the order of time: number of the piece, from 1, and when it begins and ends. */
struct DrivePiece
{
  std::size_t piece;
  Timestamp begin, end;
};
std::vector<DrivePiece> piecesOf(std::size_t drive, const Site&, const std::vector<SiteDrive>&);

/** The drive's poses in the frames of its pieces: between two keyframes their corrections are interpolated. */
Trajectory trajectoryIn(const Site&, const std::vector<SiteDrive>&, std::size_t drive);

/** What the coordinates of a site are whose largest piece is in the references' frame. */
struct SiteFrame
{
  std::optional<Geodetic> origin;   // they are east, north and up of it
  std::optional<CountryGrid> grid;  // of the LAS files; without an origin that of the site itself
};

struct SiteMap
{
  std::size_t tiles = 0;
  std::vector<GoneThing> gone;
};

/** Throws std::runtime_error if the disk does not take them. */
SiteMap writeSite(const std::filesystem::path& folder, const Site&, const std::vector<SiteDrive>&, const SiteFrame&,
                  const SiteProgress&);
}  // namespace scanloom
