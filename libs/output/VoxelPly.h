#pragma once
#include <octomap/octomap.h>

#include <filesystem>

namespace scanloom
{
enum class VoxelShape
{
  Centres,  // a vertex each
  Cubes,    // eight vertices and six faces each, 198 bytes
};

/**
 * The occupied voxels as binary PLY. @return how many. Throws std::runtime_error if it cannot be written, or for more
 * than kMostListedVoxels.
 */
std::size_t writeVoxelPly(const std::filesystem::path&, const octomap::OcTree&, VoxelShape);
}  // namespace scanloom
