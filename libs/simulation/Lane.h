/** Where the machine drives, as the stand sees it: kept free, and the world built around it. */
#pragma once
#include <tsl/robin_map.h>
#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace scanloom
{
/** A place in a square grid; a key of random numbers and of hashed cells. */
struct GridCell
{
  std::int32_t x, y;

  std::uint64_t key() const
  {
    return std::uint64_t{static_cast<std::uint32_t>(y)} << 32 | static_cast<std::uint32_t>(x);
  }
  bool operator<(const GridCell& o) const { return y != o.y ? y < o.y : x < o.x; }

  static GridCell of(const Eigen::Vector2d& p, double size);
};

class Lane
{
 public:
  /** Points in the world, m, that follow each other closely. */
  explicit Lane(const std::vector<Eigen::Vector2d>& path);

  /** Whether any point of the path is nearer than `distance`. */
  bool passes(const Eigen::Vector2d& place, double distance) const;

  /** Cells of a grid, row by row, that come as near as `reach` to the path. */
  std::vector<GridCell> cellsWithin(double reach, double cell_size) const;

 private:
  std::vector<Eigen::Vector2d> points_;
  tsl::robin_map<std::uint64_t, std::vector<std::uint32_t>> near_;  // by cell: indices into points_
};
}  // namespace scanloom
