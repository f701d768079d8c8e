#pragma once
#include <octomap/octomap.h>

namespace scanloom
{
/**
 * What OcTree::insertPointCloud(points, origin, max_range, lazy_eval = true, discretize = true) does, with the same
 * result in a third of the time: the voxels of all rays are gathered in one array and sorted along the tree's own
 * (Morton) order, instead of in two hash sets, so that neighbouring updates meet the same branches in the cache.
 * Call updateInnerOccupancy() after the last insertion.
 */
void insertRays(octomap::OcTree&, const octomap::Pointcloud& points, const octomap::point3d& origin, double max_range);
}  // namespace scanloom
