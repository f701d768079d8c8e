/** The largest piece of a site in squares of 51.2 m, one after the other, so that memory does not grow with the site.
 */
#pragma once
#include "base/positions/Geodetic.h"
#include "site/SiteFiles.h"
#include "site/internal/PlacedKeyframes.h"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace scanloom
{
/** A square of the site; its corner is at kTileEdge times its number, in coordinates less PlacedKeyframes::offset(). */
struct TileNumber
{
  int east = 0, north = 0;

  bool operator<(const TileNumber& other) const { return std::pair(east, north) < std::pair(other.east, other.north); }
};

/** Of its files: "3_-2". */
std::string nameOf(const TileNumber&);

/** Keyframes that may see each tile, in their order. */
using KeyframesByTile = std::map<TileNumber, std::vector<std::size_t>>;

struct WrittenTiles
{
  KeyframesByTile tiles;  // of which something is known
  std::vector<GoneThing> gone;
  GoneVoxels gone_voxels;
};

/** `folder`/NAME.bt of each tile. */
WrittenTiles writeTiles(const std::filesystem::path& folder, const Site&, const PlacedKeyframes&, const SiteProgress&);

/** `folder`/NAME.las: its points, from which what is gone has been left out, in the coordinates of the grid. */
void writePointTiles(const std::filesystem::path& folder, const KeyframesByTile&, const PlacedKeyframes&,
                     const SiteFrame&);
}  // namespace scanloom
