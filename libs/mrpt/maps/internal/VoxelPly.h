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
 * Writes the occupied voxels as binary PLY. @return their number. Throws std::runtime_error if the file cannot be
 * written, or for more than kMostListedVoxels.
 */
std::size_t writeVoxelPly(const std::filesystem::path&, const octomap::OcTree&, VoxelShape);
}  // namespace scanloom
