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

/** Occupied or free (.bt). Changes the tree's nodes to the more likely of both: memory may not suffice for a copy. */
void writeBinaryOctoMap(const std::filesystem::path&, octomap::OcTree&);

/** Number of voxels at the finest level; a pruned leaf counts as all voxels that it covers. */
std::uint64_t occupiedVoxels(const octomap::OcTree&);

/** The most voxels to list one by one: 3.2 GB of centres. A single leaf near the root covers up to 2^48. */
constexpr std::uint64_t kMostListedVoxels = std::numeric_limits<std::int32_t>::max() / 8;

/** Visits the centre of each occupied voxel. Throws std::runtime_error if there are more than kMostListedVoxels. */
void forEachOccupiedVoxel(const octomap::OcTree&, const std::function<void(const octomap::point3d&)>&);
}  // namespace scanloom
