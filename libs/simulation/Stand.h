#pragma once
#include "core/Field.h"
#include "simulation/Ground.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <vector>

namespace scanloom
{
/** A cylinder. */
struct Stem
{
  Eigen::Vector3d foot;
  Eigen::Vector3d axis;  // unit, upwards
  double radius = 0;     // m
  double length = 0;     // m

  /** Distance along the ray to the bark, from outside. */
  std::optional<double> intersect(const Ray&) const;
  Eigen::Vector3d normal(const Eigen::Vector3d& on_bark) const;
  double distanceToBark(const Eigen::Vector3d&) const;
};

struct StandOptions
{
  double stems_per_hectare = 700;
  double diameter = 0.22;
  double diameter_spread = 0.06;
  double tilt_deg = 2.5;
  double free_lane = 2.6;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.stems_per_hectare, Field{"stems_per_hectare", "1/ha", "density of the stand", between(0, 10000)});
    visit(o.diameter, Field{"diameter", "m", "mean diameter of the stems", between(0.03, 2)});
    visit(o.diameter_spread, Field{"diameter_spread", "m", "standard deviation of the diameters", between(0, 1)});
    visit(o.tilt_deg, Field{"tilt_deg", "deg", "standard deviation of each stem's lean", between(0, 20)});
    visit(o.free_lane, Field{"free_lane", "m", "no stem nearer to the machine's path", atLeast(0)});
  }
};

/** Stems in a grid of cells, so that a ray asks only those that it passes. */
class Stand
{
 public:
  explicit Stand(std::vector<Stem>);

  const std::vector<Stem>& stems() const { return stems_; }

  struct Hit
  {
    double range;
    const Stem* stem;
  };
  std::optional<Hit> intersect(const Ray&, double max_range) const;

 private:
  using Cell = Eigen::Array2i;
  bool contains(const Cell& cell) const { return (cell >= 0).all() && (cell < size_).all(); }
  const std::vector<std::uint32_t>& stemsIn(const Cell& cell) const { return cells_[cell.y() * size_.x() + cell.x()]; }

  std::vector<Stem> stems_;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();  // of cell (0, 0)
  Cell size_ = Cell::Zero();
  std::vector<std::vector<std::uint32_t>> cells_;  // row by row: indices into stems_
};

/**
 * Stems at random on the ground of `area`, at least 0.8 m apart and options.free_lane from every point of `path`. The
 * same seed gives the same stand.
 */
std::vector<Stem> growStems(const StandOptions&, const Ground&, const Eigen::AlignedBox2d& area,
                            const std::vector<Eigen::Vector2d>& path, std::uint64_t seed);
}  // namespace scanloom
