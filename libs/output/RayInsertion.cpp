#include "output/RayInsertion.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

namespace scanloom
{
namespace
{
/** A voxel's key with the bits of x, y and z interleaved: sorted codes walk the tree branch by branch. */
using MortonCode = std::uint64_t;

/** The 16 bits of a key's coordinate, moved to every third place. */
constexpr MortonCode spread(std::uint64_t bits)
{
  bits = (bits | bits << 16) & 0x001F0000FF0000FF;
  bits = (bits | bits << 8) & 0x100F00F00F00F00F;
  bits = (bits | bits << 4) & 0x10C30C30C30C30C3;
  return (bits | bits << 2) & 0x1249249249249249;
}

constexpr std::uint16_t gather(MortonCode code)
{
  code &= 0x1249249249249249;
  code = (code | code >> 2) & 0x10C30C30C30C30C3;
  code = (code | code >> 4) & 0x100F00F00F00F00F;
  code = (code | code >> 8) & 0x001F0000FF0000FF;
  return static_cast<std::uint16_t>(code | code >> 16);
}
static_assert(gather(spread(0xA5C3)) == 0xA5C3 && spread(0x8001) == (1ULL << 45 | 1));

MortonCode codeOf(const octomap::OcTreeKey& key) { return spread(key[0]) | spread(key[1]) << 1 | spread(key[2]) << 2; }

octomap::OcTreeKey keyOf(MortonCode code) { return {gather(code), gather(code >> 1), gather(code >> 2)}; }

void sortUnique(std::vector<MortonCode>& codes)
{
  std::sort(codes.begin(), codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
}
}  // namespace

void insertRays(octomap::OcTree& tree, const octomap::Pointcloud& points, const octomap::point3d& origin,
                double max_range)
{
  std::vector<MortonCode> ends;  // many points share a voxel near the lidar: one ray for all of them
  for (const octomap::point3d& point : points)
    if (octomap::OcTreeKey key; tree.coordToKeyChecked(point, key)) ends.push_back(codeOf(key));
  sortUnique(ends);

  std::vector<MortonCode> occupied, passed;
  octomap::KeyRay ray;
  for (const MortonCode code : ends)
  {
    octomap::point3d end = tree.keyToCoord(keyOf(code));
    const bool in_reach = (end - origin).norm() <= max_range;
    if (in_reach) occupied.push_back(code);
    if (!in_reach) end = origin + (end - origin).normalized() * static_cast<float>(max_range);
    if (!tree.computeRayKeys(origin, end, ray)) continue;
    std::transform(ray.begin(), ray.end(), std::back_inserter(passed), codeOf);
  }
  sortUnique(passed);
  std::vector<MortonCode> free;  // within one scan a hit outweighs every ray that grazes the same voxel
  std::set_difference(passed.begin(), passed.end(), occupied.begin(), occupied.end(), std::back_inserter(free));

  constexpr bool kInnerNodesLater = true;
  for (const MortonCode code : free) tree.updateNode(keyOf(code), false, kInnerNodesLater);
  for (const MortonCode code : occupied) tree.updateNode(keyOf(code), true, kInnerNodesLater);
}
}  // namespace scanloom
