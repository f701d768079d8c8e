/** A square of a site's map, in which the drives are compared. */
#pragma once
#include "base/core/Keyframe.h"
#include "mrpt/maps/OctoMapExport.h"
#include "site/GoneThing.h"

#include <octomap/OcTree.h>

#include <functional>
#include <memory>
#include <vector>

namespace scanloom
{
/** Voxels of 0.2 m, and rays up to 30 m. */
OctoMapOptions tileOptions();

/** m: 8 blocks of 32 voxels, as OctoMapBuilder needs it. */
constexpr double kTileEdge = 51.2;

/** Where points of drives before `gone_by` are no longer true. */
struct GoneVoxel
{
  octomap::OcTreeKey key;
  std::size_t gone_by;
};

struct MapTile
{
  std::unique_ptr<octomap::OcTree> tree;  // without what is gone; null: nothing is known of it
  std::vector<GoneThing> gone;
  std::vector<GoneVoxel> gone_voxels;
};

/** Calls for each keyframe of a drive that may see the tile. */
using KeyframesOfDrive = std::function<void(std::size_t drive, const std::function<void(const Keyframe&)>&)>;

/**
 * `drives`: the oldest first. A thing is gone if a later drive saw at least three times through most of its voxels and
 * hit none beside them, and if it was 1 m high: leaves and twigs that moved are not listed.
 */
MapTile tileOf(const MapArea&, const std::vector<std::size_t>& drives, const KeyframesOfDrive&,
               const std::vector<Rigid>& body_T_sensor);
}  // namespace scanloom
