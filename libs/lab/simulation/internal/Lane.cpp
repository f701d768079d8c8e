#include "lab/simulation/internal/Lane.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace scanloom
{
namespace
{
constexpr double kLaneCell = 4.0;       // m
constexpr double kLeastAdvance = 0.05;  // m: a machine at rest adds no points
}  // namespace

GridCell GridCell::of(const Eigen::Vector2d& p, double size)
{
  return {static_cast<std::int32_t>(std::floor(p.x() / size)), static_cast<std::int32_t>(std::floor(p.y() / size))};
}

Lane::Lane(const std::vector<Eigen::Vector2d>& path)
{
  for (const Eigen::Vector2d& p : path)
  {
    if (!points_.empty() && (p - points_.back()).norm() < kLeastAdvance) continue;
    near_[GridCell::of(p, kLaneCell).key()].push_back(static_cast<std::uint32_t>(points_.size()));
    points_.push_back(p);
  }
}

bool Lane::passes(const Eigen::Vector2d& place, double distance) const
{
  const Eigen::Vector2d around = Eigen::Vector2d::Constant(distance);
  const GridCell first = GridCell::of(place - around, kLaneCell), last = GridCell::of(place + around, kLaneCell);
  const auto isNear = [&](std::uint32_t i) { return (points_[i] - place).squaredNorm() < distance * distance; };
  for (std::int32_t y = first.y; y <= last.y; ++y)
    for (std::int32_t x = first.x; x <= last.x; ++x)
      if (const auto cell = near_.find(GridCell{x, y}.key());
          cell != near_.end() && std::any_of(cell->second.begin(), cell->second.end(), isNear))
        return true;
  return false;
}

std::vector<GridCell> Lane::cellsWithin(double reach, double cell_size) const
{
  std::set<GridCell> cells;
  const Eigen::Vector2d around = Eigen::Vector2d::Constant(reach);
  std::optional<Eigen::Vector2d> last_looked_from;
  for (const Eigen::Vector2d& p : points_)
  {
    if (last_looked_from && (p - *last_looked_from).norm() < 0.25 * cell_size) continue;
    last_looked_from = p;
    const GridCell first = GridCell::of(p - around, cell_size), last = GridCell::of(p + around, cell_size);
    for (std::int32_t y = first.y; y <= last.y; ++y)
      for (std::int32_t x = first.x; x <= last.x; ++x)
      {
        const Eigen::Vector2d corner(x * cell_size, y * cell_size);
        const Eigen::Vector2d nearest = p.cwiseMax(corner).cwiseMin(corner + Eigen::Vector2d::Constant(cell_size));
        if ((nearest - p).norm() < reach + 0.25 * cell_size) cells.insert({x, y});
      }
  }
  return {cells.begin(), cells.end()};
}
}  // namespace scanloom
