/** Occupancy trees in OctoMap's own formats. */
#pragma once
#include <octomap/octomap.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>

namespace scanloom
{
/** .bt or .ot. Throws std::runtime_error with the path if it is neither, holds no OcTree or is cut short. */
std::unique_ptr<octomap::OcTree> readOctoMap(const std::filesystem::path&);

/** Log odds (.ot). Throws std::runtime_error if it cannot be written. */
void writeFullOctoMap(const std::filesystem::path&, const octomap::OcTree&);

/** Occupied or free (.bt): the most likely of both, to which the tree is changed, since a copy may not fit. */
void writeBinaryOctoMap(const std::filesystem::path&, octomap::OcTree&);

/** Of the finest level: a pruned leaf is all those that it stands for. */
std::uint64_t occupiedVoxels(const octomap::OcTree&);

/** Of more than these nobody makes a list: 3.2 GB of centres; a leaf near the root alone stands for up to 2^48. */
constexpr std::uint64_t kMostListedVoxels = std::numeric_limits<std::int32_t>::max() / 8;

/** Visits the centre of each occupied voxel. Throws std::runtime_error before the first if there are too many. */
void forEachOccupiedVoxel(const octomap::OcTree&, const std::function<void(const octomap::point3d&)>&);
}  // namespace scanloom
