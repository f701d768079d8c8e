#include "mrpt/maps/internal/VoxelPly.h"

#include "base/core/OutputFile.h"
#include "base/formats/LittleEndianBuffer.h"
#include "mrpt/maps/OctoMapFile.h"

#include <fmt/ostream.h>

namespace scanloom
{
void writeVoxelPly(const std::filesystem::path& path, const octomap::OcTree& tree)
{
  OutputFile file(path);
  fmt::print(file.stream(),
             "ply\nformat binary_little_endian 1.0\ncomment occupied voxels of {} m\nelement vertex {}\n"
             "property float x\nproperty float y\nproperty float z\nend_header\n",
             tree.getResolution(), occupiedVoxels(tree));

  LittleEndianBuffer buffer;
  forEachOccupiedVoxel(tree,
                       [&](const octomap::point3d& centre)
                       {
                         for (unsigned axis = 0; axis < 3; ++axis) buffer.put(centre(axis));
                         buffer.writeTo(file.stream());
                       });
  file.commit();
}
}  // namespace scanloom
