#pragma once
#include <octomap/octomap.h>

#include <filesystem>

namespace scanloom
{
/**
 * Writes the centres of the occupied voxels as binary PLY. Throws std::runtime_error if the file cannot be written, or
 * for more than kMostListedVoxels.
 */
void writeVoxelPly(const std::filesystem::path&, const octomap::OcTree&);
}  // namespace scanloom
