#include "site/internal/SiteTiles.h"

#include "base/formats/CloudWriter.h"
#include "mrpt/maps/OctoMapFile.h"
#include "site/internal/MapTile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace scanloom
{
namespace
{
Eigen::Vector2d cornerOf(const TileNumber& tile) { return kTileEdge * Eigen::Vector2d(tile.east, tile.north); }

/** m, from the square; 0 within. */
double distanceOf(const Eigen::Vector3d& place, const TileNumber& tile)
{
  const Eigen::Vector2d least = cornerOf(tile), most = least.array() + kTileEdge;
  const Eigen::Vector2d p = place.head<2>();
  return (p - p.cwiseMax(least).cwiseMin(most)).norm();
}

KeyframesByTile keyframesByTile(const Site& site, const PlacedKeyframes& placed)
{
  const double sight = tileOptions().max_range;
  KeyframesByTile by_tile;
  for (const std::size_t i : site.pieces.front().keyframes)
  {
    const Eigen::Vector3d at = site.keyframes[i].site_T_body.translation - placed.offset();
    const auto number = [&](double coordinate) { return static_cast<int>(std::floor(coordinate / kTileEdge)); };
    for (int east = number(at.x() - sight); east <= number(at.x() + sight); ++east)
      for (int north = number(at.y() - sight); north <= number(at.y() + sight); ++north)
        if (const TileNumber tile{east, north}; distanceOf(at, tile) < sight) by_tile[tile].push_back(i);
  }
  return by_tile;
}

std::vector<std::size_t> drivesOf(const std::vector<std::size_t>& keyframes, const Site& site)
{
  std::set<std::size_t> drives;
  for (const std::size_t i : keyframes) drives.insert(site.keyframes[i].drive);
  return {drives.begin(), drives.end()};
}

/** A thing that a tile's border divides is one. */
std::vector<GoneThing> joined(const std::vector<GoneThing>& things)
{
  constexpr double kOne = 0.5;  // m, beside each other
  std::vector<GoneThing> all;
  for (const GoneThing& thing : things)
  {
    const auto same =
        std::find_if(all.begin(), all.end(),
                     [&](const GoneThing& other)
                     { return other.gone_by == thing.gone_by && (other.foot - thing.foot).head<2>().norm() < kOne; });
    if (same == all.end())
    {
      all.push_back(thing);
      continue;
    }
    const double top = std::max(same->foot.z() + same->height, thing.foot.z() + thing.height);
    same->foot.z() = std::min(same->foot.z(), thing.foot.z());
    same->height = top - same->foot.z();
    same->width = std::max(same->width, thing.width);
  }
  return all;
}

/** m, from the way that a drive took, as straight lines between its keyframes. */
double distanceFromWay(const Eigen::Vector3d& place, std::size_t drive, const Site& site)
{
  double least = std::numeric_limits<double>::infinity();
  const SiteKeyframe* before = nullptr;
  for (const std::size_t i : site.pieces.front().keyframes)
  {
    const SiteKeyframe& keyframe = site.keyframes[i];
    if (keyframe.drive != drive) continue;
    const Eigen::Vector2d end = keyframe.site_T_body.translation.head<2>();
    const Eigen::Vector2d begin = before ? before->site_T_body.translation.head<2>().eval() : end;
    const double length = (end - begin).norm();
    const Eigen::Vector2d from = place.head<2>() - begin;
    const double along = length > 0 ? std::clamp(from.dot(end - begin) / length, 0.0, length) : 0;
    least = std::min(least, (from - along / std::max(length, 1e-9) * (end - begin)).norm());
    before = &keyframe;
  }
  return least;
}

/** What stood where a machine drove was a part of it. */
std::vector<GoneThing> withoutMachines(const std::vector<GoneThing>& things, const Site& site)
{
  constexpr double kMachine = 2.5;  // m, half of its width, with the boom beside it
  std::vector<GoneThing> kept;
  for (const GoneThing& thing : things)
  {
    bool is_machine = false;
    for (std::size_t drive = 0; drive < thing.gone_by; ++drive)
      is_machine |= distanceFromWay(thing.foot, drive, site) < kMachine;
    if (!is_machine) kept.push_back(thing);
  }
  return kept;
}

/** Over a tile a grid's coordinates are linear in those of the site to a tenth of a millimetre. */
Eigen::Affine3d gridAround(const Eigen::Vector3d& place, const SiteFrame& frame)
{
  Eigen::Affine3d grid_T_site = Eigen::Affine3d::Identity();
  if (!frame.origin || !frame.grid) return grid_T_site;
  const auto inGrid = [&](const Eigen::Vector3d& at) { return frame.grid->of(geodeticOf(at, *frame.origin)); };
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d half = kTileEdge / 2 * Eigen::Vector3d::Unit(axis);
    grid_T_site.linear().col(axis) = (inGrid(place + half) - inGrid(place - half)) / kTileEdge;
  }
  grid_T_site.translation() = inGrid(place) - grid_T_site.linear() * place;
  return grid_T_site;
}

/** The keyframe's points in the tile, as the file has them. */
PointCloud pointsIn(const TileNumber& tile, const Keyframe& keyframe, const Eigen::Affine3d& file_T_tile)
{
  PointCloud inside;
  const Eigen::Vector2d least = cornerOf(tile);
  for (std::size_t i = 0; i < keyframe.points.size(); ++i)
  {
    const Eigen::Vector3d p = keyframe.map_T_body * keyframe.points.position(i).cast<double>().eval();
    const Eigen::Array2d within = p.head<2>() - least;
    if ((within < 0).any() || (within >= kTileEdge).any()) continue;
    inside.append(keyframe.points, i);
    const Eigen::Vector3f in_file = (file_T_tile * p).cast<float>();
    inside.x[inside.size() - 1] = in_file.x();
    inside.y[inside.size() - 1] = in_file.y();
    inside.z[inside.size() - 1] = in_file.z();
  }
  return inside;
}
}  // namespace

std::string nameOf(const TileNumber& tile) { return fmt::format("{}_{}", tile.east, tile.north); }

WrittenTiles writeTiles(const std::filesystem::path& folder, const Site& site, const PlacedKeyframes& placed,
                        const SiteProgress& progress)
{
  WrittenTiles written;
  const KeyframesByTile by_tile = keyframesByTile(site, placed);
  std::size_t done = 0;
  for (const auto& [number, near] : by_tile)
  {
    const auto ofDrive = [&, &keyframes = near](std::size_t drive, const std::function<void(const Keyframe&)>& visit)
    {
      for (const std::size_t i : keyframes)
        if (site.keyframes[i].drive == drive) visit(placed.lessOffset(i));
    };
    const MapTile tile = tileOf({cornerOf(number), kTileEdge}, drivesOf(near, site), ofDrive, posesOf(placed.lidars()));
    for (const GoneVoxel& voxel : tile.gone_voxels) written.gone_voxels.add(voxel.key, voxel.gone_by);
    written.gone.insert(written.gone.end(), tile.gone.begin(), tile.gone.end());
    progress(static_cast<double>(++done) / static_cast<double>(by_tile.size()));
    if (!tile.tree) continue;
    writeBinaryOctoMap(folder / (nameOf(number) + ".bt"), *tile.tree);
    written.tiles.emplace(number, near);
  }
  written.gone = joined(written.gone);
  for (GoneThing& thing : written.gone) thing.foot += placed.offset();
  written.gone = withoutMachines(written.gone, site);
  return written;
}

void writePointTiles(const std::filesystem::path& folder, const KeyframesByTile& tiles, const PlacedKeyframes& placed,
                     const SiteFrame& frame)
{
  for (const auto& [tile, near] : tiles)
  {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    middle.head<2>() = cornerOf(tile).array() + kTileEdge / 2;
    const Eigen::Affine3d grid_T_site = gridAround(middle + placed.offset(), frame);
    constexpr double kWhole = 1000;  // m
    const Eigen::Vector3d offset =
        kWhole * (grid_T_site * (middle + placed.offset()) / kWhole).array().floor() * Eigen::Array3d(1, 1, 0);
    const Eigen::Affine3d file_T_tile =
        Eigen::Translation3d(-offset) * grid_T_site * Eigen::Translation3d(placed.offset());
    CloudWriter file(folder / (nameOf(tile) + ".las"), offset, frame.grid->wkt());
    for (const std::size_t i : near)
    {
      const Keyframe keyframe = placed.lessOffset(i);
      file.add(pointsIn(tile, keyframe, file_T_tile), keyframe.stamp, {Eigen::Quaterniond::Identity(), offset});
    }
    file.close();
  }
}
}  // namespace scanloom
