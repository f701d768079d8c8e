/** The machine's path: the stand is grown around it and keeps it free. */
#pragma once
#include <tsl/robin_map.h>
#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace scanloom
{
/** A cell of a square grid. */
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
  /** `path`: points (x, y) in the world, m, close to each other. */
  explicit Lane(const std::vector<Eigen::Vector2d>& path);

  /** Whether `place` is nearer than `distance` to a point of the path. */
  bool passes(const Eigen::Vector2d& place, double distance) const;

  /** Cells with a part within `reach` of the path, row by row. */
  std::vector<GridCell> cellsWithin(double reach, double cell_size) const;

 private:
  std::vector<Eigen::Vector2d> points_;
  tsl::robin_map<std::uint64_t, std::vector<std::uint32_t>> near_;  // by cell: indices into points_
};
}  // namespace scanloom
