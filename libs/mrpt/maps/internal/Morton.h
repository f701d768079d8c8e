/** Morton codes: one number per voxel of an octree, in the order of the tree's branches. */
#pragma once
#include <octomap/OcTree.h>

#include <cstdint>

namespace scanloom
{
/** A voxel's key with the bits of x, y and z interleaved, x lowest: three bits a level, the tree's child indices. */
using MortonCode = std::uint64_t;

constexpr MortonCode kEveryThirdBit = 0x1249249249249;  // 16 of them

/** The 16 bits of a key's coordinate, moved to every third place. */
constexpr MortonCode spread(std::uint64_t bits)
{
  bits = (bits | bits << 16) & 0x001F0000FF0000FF;
  bits = (bits | bits << 8) & 0x100F00F00F00F00F;
  bits = (bits | bits << 4) & 0x10C30C30C30C30C3;
  return (bits | bits << 2) & kEveryThirdBit;
}

constexpr std::uint16_t gather(MortonCode code)
{
  code &= kEveryThirdBit;
  code = (code | code >> 2) & 0x10C30C30C30C30C3;
  code = (code | code >> 4) & 0x100F00F00F00F00F;
  code = (code | code >> 8) & 0x001F0000FF0000FF;
  return static_cast<std::uint16_t>(code | code >> 16);
}
static_assert(gather(spread(0xA5C3)) == 0xA5C3 && spread(0x8001) == (1ULL << 45 | 1));

inline MortonCode codeOf(const octomap::OcTreeKey& key)
{
  return spread(key[0]) | spread(key[1]) << 1 | spread(key[2]) << 2;
}

inline octomap::OcTreeKey keyOf(MortonCode code) { return {gather(code), gather(code >> 1), gather(code >> 2)}; }
}  // namespace scanloom
