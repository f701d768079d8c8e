#include "mrpt/maps/internal/VoxelPly.h"

#include "base/core/OutputFile.h"
#include "base/formats/LittleEndianBuffer.h"
#include "mrpt/maps/OctoMapFile.h"

#include <fmt/ostream.h>

#include <array>
#include <cstdint>
#include <limits>

namespace scanloom
{
namespace
{
constexpr std::int32_t kCorners = 8, kFaces = 6, kCornersOfFace = 4;

/** Corner i has x, y, z at the upper end where bits 0, 1, 2 of i are set; counterclockwise seen from outside. */
constexpr std::array<std::array<std::int32_t, kCornersOfFace>, kFaces> kFacesOfCube{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

void put(LittleEndianBuffer& buffer, const octomap::point3d& p)
{
  for (unsigned axis = 0; axis < 3; ++axis) buffer.put(p(axis));
}

void putCorners(LittleEndianBuffer& buffer, const octomap::point3d& centre, float half)
{
  for (int corner = 0; corner < kCorners; ++corner)
    put(buffer,
        centre + octomap::point3d(corner & 1 ? half : -half, corner & 2 ? half : -half, corner & 4 ? half : -half));
}

void putFaces(LittleEndianBuffer& buffer, std::int32_t first_corner)
{
  for (const auto& face : kFacesOfCube)
  {
    buffer.put(static_cast<std::uint8_t>(kCornersOfFace));
    for (const std::int32_t corner : face) buffer.put(first_corner + corner);
  }
}
}  // namespace

std::size_t writeVoxelPly(const std::filesystem::path& path, const octomap::OcTree& tree, VoxelShape shape)
{
  const bool cubes = shape == VoxelShape::Cubes;
  const std::size_t voxels = occupiedVoxels(tree);
  static_assert(kMostListedVoxels * kCorners <= std::numeric_limits<std::int32_t>::max(), "faces number their corners");

  OutputFile file(path);
  fmt::print(file.stream(),
             "ply\nformat binary_little_endian 1.0\ncomment occupied voxels of {} m\nelement vertex {}\n"
             "property float x\nproperty float y\nproperty float z\n",
             tree.getResolution(), cubes ? voxels * kCorners : voxels);
  if (cubes) fmt::print(file.stream(), "element face {}\nproperty list uchar int vertex_indices\n", voxels * kFaces);
  file.stream() << "end_header\n";

  const auto half = static_cast<float>(tree.getResolution() / 2);
  LittleEndianBuffer buffer;
  forEachOccupiedVoxel(tree,
                       [&](const octomap::point3d& centre)
                       {
                         cubes ? putCorners(buffer, centre, half) : put(buffer, centre);
                         buffer.writeTo(file.stream());
                       });
  for (std::size_t i = 0; cubes && i < voxels; ++i)
  {
    putFaces(buffer, static_cast<std::int32_t>(i * kCorners));
    buffer.writeTo(file.stream());
  }
  file.commit();
  return voxels;
}
}  // namespace scanloom
