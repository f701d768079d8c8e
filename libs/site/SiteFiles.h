/**
 * The files of a site:
 *   keyframes.simplemap   the largest piece, for `slam --map`, `map` and MRPT's tools; poses with their covariances
 *   pieces/N.simplemap    the others, from 2 on
 *   drives/NAME.tum       the poses of each drive, in the frame of its piece
 *   loops.csv             every pair of keyframes that was searched, and whether it is believed
 *   references.csv        every position of a reference during a drive, and what is left of it
 *   site.png              the largest piece from above, with drives and loops
 *   site.json             drives, pieces, counts
 */
#pragma once
#include "base/positions/Geodetic.h"
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

/** `origin`: of a site that is east, north and up of it. Throws std::runtime_error if the disk does not take them. */
void writeSite(const std::filesystem::path& folder, const Site&, const std::vector<SiteDrive>&,
               const std::optional<Geodetic>& origin);
}  // namespace scanloom
