#include "preprocessing/Thin.h"

#include <cmath>
#include <stdexcept>
#include <unordered_set>

namespace scanloom
{
namespace
{
/** 21 bits per axis: 0.1 m cubes reach 100 km. */
std::uint64_t keyOf(const Eigen::Vector3f& p, double edge)
{
  const auto part = [edge](float v)
  { return static_cast<std::uint64_t>(std::llround(std::floor(v / edge))) & 0x1FFFFF; };
  return part(p.x()) << 42 | part(p.y()) << 21 | part(p.z());
}
}  // namespace

PointCloud thin(PointCloud points, double edge)
{
  if (!(edge > 0)) throw std::invalid_argument("thin: the edge must be positive");
  std::unordered_set<std::uint64_t> taken;  // only asked, never iterated
  taken.reserve(points.size());
  std::vector<std::uint8_t> keep(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    keep[i] = points.position(i).allFinite() && taken.insert(keyOf(points.position(i), edge)).second;
  points.keep(keep);
  return points;
}
}  // namespace scanloom
