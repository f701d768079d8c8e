/** Space cut into cubes with a normal distribution of the points in each: what scans and local maps are aligned by. */
#pragma once
#include "core/Field.h"
#include "core/PointCloud.h"
#include "ndt/CellBins.h"
#include "ndt/View.h"

#include <tsl/robin_map.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scanloom
{
struct NdtOptions
{
  double cell_size = 1.0;
  int min_points = 4;
  double min_deviation = 0.03;
  int max_cells = 0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.cell_size, Field{"cell_size", "m", "edge of a cell", between(0.05, 10)});
    visit(o.min_points, Field{"min_points", "", "points that a cell needs to count", atLeast(1)});
    visit(o.min_deviation, Field{"min_deviation", "m", "floor of a cell's standard deviations", above(0)});
    visit(o.max_cells,
          Field{"max_cells", "", "a cloud with more loses, evenly, cells of fewer than 4 points; 0: none", atLeast(0)});
  }
};

/**
 * Sums of points per cell, and the Gaussians of the cells that have enough of them.
 *
 * The same points give the same bits in any order, whether added at once or map by map, on any number of threads (see
 * Moments). Cells are listed in the order of their CellKey: no hash decides it. The edge of a cell is rounded to a
 * multiple of 1/65536 m.
 */
class NdtMap
{
 public:
  /** Throws std::invalid_argument if an option is out of its bounds. */
  explicit NdtMap(const NdtOptions&);
  NdtMap(const PointCloud&, const NdtOptions&);
  NdtMap(const std::vector<Eigen::Vector3f>&, const NdtOptions&);
  /** Points of stems and poles stand on their axes (see moveToAxes), as far as viewpoints are known. */
  NdtMap(const std::vector<View>&, const NdtOptions&);

  /** Adds points given in the map's frame. Those that are not finite or too far for an index are left out and counted.
   */
  void add(const PointCloud& points_in_map);
  void add(const std::vector<Eigen::Vector3f>& points_in_map);

  /**
   * Adds or takes out the points of a map in the same frame: only the cells of `other` are computed anew. Throws
   * std::invalid_argument if the cell sizes differ.
   */
  void add(const NdtMap& other);
  void remove(const NdtMap& other);

  /** The same points in cells of `factor` times the edge, from sums: no point is binned again. `factor` from 2. */
  NdtMap coarser(int factor) const;

  /** Cells with enough points, in the order of their keys. */
  const std::vector<GaussianCell>& cells() const { return cells_; }

  /** The Gaussian of a cell; nullptr where there is none. Valid until the map is changed. */
  const GaussianCell* cellAt(const Eigen::Vector3i& index) const;
  Eigen::Vector3i indexOf(const Eigen::Vector3d& point) const;

  /**
   * Writes the places in cells() of the Gaussians among the 1, 7 or 27 cells around `index`, itself included, and
   * returns how many. Another number throws nothing and finds nothing.
   */
  std::size_t findAround(const Eigen::Vector3i& index, int neighbours, std::uint32_t* found) const;

  std::size_t points() const { return points_; }
  std::size_t pointsLeftOut() const { return points_left_out_; }
  const NdtOptions& options() const { return options_; }

 private:
  /** Of 4 x 4 x 4 cells, those that have a Gaussian: a bit each, and where in cells_ they begin. */
  struct Block
  {
    std::uint64_t cells = 0;
    std::uint32_t first = 0;
  };

  NdtMap(const NdtOptions&, std::int64_t cell_quanta, const std::vector<Bin>&);

  void add(const Coordinates&);
  void begin(const CellBins&);
  template <typename Combine>
  void combine(const std::vector<Bin>& others, Combine&&);
  void requireSameCells(const NdtMap& other) const;
  bool hasGaussian(const Bin& bin) const { return bin.moments.n >= options_.min_points; }
  GaussianCell gaussianOfBin(const Bin&) const;
  void indexBlocks();

  NdtOptions options_;
  std::int64_t cell_quanta_;  // edge of a cell in Moments::kQuantum
  std::vector<Bin> bins_;     // sorted by key, also those with too few points
  std::vector<GaussianCell> cells_;
  tsl::robin_map<std::uint64_t, Block, KeyHash> blocks_;  // only looked up, never iterated
  std::size_t points_ = 0;
  std::size_t points_left_out_ = 0;
};

/**
 * The points in cells of each size, in the order given; their size in `options` does not count. Points are binned once
 * into the smallest cells and once more for each size that is no multiple of it. Throws std::invalid_argument for no
 * size and as NdtMap does.
 */
std::vector<NdtMap> ndtLevels(const std::vector<Eigen::Vector3f>&, const std::vector<double>& cell_sizes, NdtOptions);
std::vector<NdtMap> ndtLevels(const std::vector<View>&, const std::vector<double>& cell_sizes, NdtOptions);
}  // namespace scanloom
