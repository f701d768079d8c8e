/** Cells of a grid as numbers for hash tables. */
#pragma once
#include <Eigen/Core>

#include <cmath>
#include <cstdint>

namespace scanloom
{
/** The low 21 bits of each index: different for all cells that are less than 2^21 apart along each axis. */
inline std::uint64_t voxelKey(std::int64_t high, std::int64_t middle, std::int64_t low)
{
  const auto part = [](std::int64_t index) { return static_cast<std::uint64_t>(index) & 0x1FFFFF; };
  return part(high) << 42 | part(middle) << 21 | part(low);
}

/** Of the cube with this edge (m) that holds the point. */
inline std::uint64_t voxelKey(const Eigen::Vector3f& p, double edge)
{
  const auto index = [edge](float v) { return std::llround(std::floor(v / edge)); };
  return voxelKey(index(p.x()), index(p.y()), index(p.z()));
}
}  // namespace scanloom
