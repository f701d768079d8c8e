/** Space cut into cubes with a normal distribution of the points in each: what scans and local maps are aligned by. */
#pragma once
#include "core/Field.h"
#include "core/PointCloud.h"
#include "ndt/GaussianCell.h"

#include <tsl/robin_map.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace scanloom
{
struct NdtOptions
{
  double cell_size = 1.0;
  int min_points = 6;
  double min_deviation = 0.03;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.cell_size, Field{"cell_size", "m", "edge of a cell", between(0.05, 10)});
    visit(o.min_points, Field{"min_points", "", "points that a cell needs to count", atLeast(4)});
    visit(o.min_deviation, Field{"min_deviation", "m", "floor of a cell's standard deviations", above(0)});
  }
};

/**
 * Sums of points per cell, and the Gaussians of the cells that have enough of them.
 *
 * The same points give the same bits in any order, whether added at once or map by map (see Moments). Cells are listed
 * in the order of their index (z, y, x): no hash decides it. The edge of a cell is rounded to a multiple of 1/65536 m.
 */
class NdtMap
{
 public:
  /** Throws std::invalid_argument if an option is out of its bounds. */
  explicit NdtMap(const NdtOptions&);
  NdtMap(const PointCloud&, const NdtOptions&);
  NdtMap(const std::vector<Eigen::Vector3f>&, const NdtOptions&);

  /** Adds points given in the map's frame. Those that are not finite or too far for an index are left out and counted.
   */
  void add(const PointCloud& points_in_map);
  void add(const std::vector<Eigen::Vector3f>& points_in_map);

  /** Adds or takes out the points of a map in the same frame; throws std::invalid_argument if the cell sizes differ. */
  void add(const NdtMap& other);
  void remove(const NdtMap& other);

  /** Cells with enough points, sorted by index. */
  const std::vector<GaussianCell>& cells() const { return cells_; }

  /** The Gaussian of a cell; nullptr where there is none. Valid until the map is changed. */
  const GaussianCell* cellAt(const Eigen::Vector3i& index) const;
  Eigen::Vector3i indexOf(const Eigen::Vector3d& point) const;

  std::size_t points() const { return points_; }
  std::size_t pointsLeftOut() const { return points_left_out_; }
  const NdtOptions& options() const { return options_; }

 private:
  struct Bin
  {
    std::uint64_t key;
    Moments moments;
  };
  struct KeyHash
  {
    std::size_t operator()(std::uint64_t key) const
    {
      return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15u) >> 24);
    }
  };

  template <typename PositionOf>
  void addPoints(std::size_t count, PositionOf&& positionOf);
  template <typename Combine>
  void combine(const std::vector<Bin>& sorted_bins, Combine&&);
  void requireSameCells(const NdtMap& other) const;
  void computeGaussians();

  NdtOptions options_;
  std::int64_t cell_quanta_;  // edge of a cell in Moments::kQuantum
  std::vector<Bin> bins_;     // sorted by key, also those with too few points
  std::vector<GaussianCell> cells_;
  tsl::robin_map<std::uint64_t, std::uint32_t, KeyHash> cell_of_key_;  // only looked up, never iterated
  std::size_t points_ = 0;
  std::size_t points_left_out_ = 0;
};
}  // namespace scanloom
