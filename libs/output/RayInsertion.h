#pragma once
#include <octomap/octomap.h>

namespace scanloom
{
/**
 * What OcTree::insertPointCloud(points, origin, max_range, lazy_eval = true, discretize = true) does, with the same
 * result: the rays mark their voxels in bitmaps instead of hash sets (VoxelMarks), threads sharing the rays, and each
 * block of 32 x 32 x 32 voxels is then updated on one way through its branches instead of one from the root per voxel.
 * Call updateInnerOccupancy() after the last insertion. Trees with a bounding box or change detection are none of its.
 */
void insertRays(octomap::OcTree&, const octomap::Pointcloud& points, const octomap::point3d& origin, double max_range);
}  // namespace scanloom
