#pragma once
#include "mrpt/maps/OctoMapExport.h"

#include <octomap/octomap.h>

#include <optional>

namespace scanloom
{
/**
 * The same result as OcTree::insertPointCloud(points, origin, max_range, lazy_eval = true, discretize = true), faster:
 * several threads mark the voxels of the rays in bitmaps (VoxelMarks) instead of hash sets, and the tree is descended
 * once per block of 32 x 32 x 32 voxels, not once per voxel. Call updateInnerOccupancy() after the last insertion.
 * `area`: blocks elsewhere are left out. Does not support change detection.
 */
void insertRays(octomap::OcTree&, const octomap::Pointcloud& points, const octomap::point3d& origin, double max_range,
                const std::optional<MapArea>& area = std::nullopt);
}  // namespace scanloom
