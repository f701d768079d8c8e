/** Occupancy trees in OctoMap's own formats. */
#pragma once
#include <octomap/octomap.h>

#include <filesystem>
#include <functional>
#include <memory>

namespace scanloom
{
/** .bt or .ot. Throws std::runtime_error with the path if it is neither, holds no OcTree or is cut short. */
std::unique_ptr<octomap::OcTree> readOctoMap(const std::filesystem::path&);

/** Log odds (.ot). Throws std::runtime_error if it cannot be written. */
void writeFullOctoMap(const std::filesystem::path&, const octomap::OcTree&);

/** Occupied or free (.bt): the most likely of both, to which the tree is changed, since a copy may not fit. */
void writeBinaryOctoMap(const std::filesystem::path&, octomap::OcTree&);

/** Visits the centre of each occupied voxel of the finest level: a pruned leaf is all those that it stands for. */
void forEachOccupiedVoxel(const octomap::OcTree&, const std::function<void(const octomap::point3d&)>&);
}  // namespace scanloom
