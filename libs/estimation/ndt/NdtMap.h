/** Space divided into cubes with a normal distribution of the points in each: scans and local maps are aligned by them.
 */
#pragma once
#include "base/core/Field.h"
#include "base/core/PointCloud.h"
#include "estimation/ndt/View.h"
#include "estimation/ndt/internal/CellBins.h"

#include <tsl/robin_map.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace scanloom
{
struct NdtOptions
{
  double cell_size = 1.0;
  int min_points = 4;           // cells with fewer points are not used
  double min_deviation = 0.03;  // m: standard deviations of a cell below this are raised to it
  int max_cells = 0;  // above this number of cells, those with fewer than 4 points are thinned evenly; 0: never

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.cell_size, Field{"cell_size", "m", "edge of a cell", between(0.05, 10)});
  }
};

/**
 * The views' points, counted into cells. Those of views with a viewpoint are corrected as each View says; with rings,
 * cells are widened across them (widenedAcrossRings), and those of one to three points on a plane or a ring left out.
 * Throws std::invalid_argument if an option is out of its bounds.
 */
BinnedPoints binned(const std::vector<View>&, const NdtOptions&);

/**
 * Orientation of a map's cubes in the frame of its points: along the axes, or turned against them.
 *
 * Where structure fills cells, as leaves do, their means follow the grid, not the world. If the grids of map and scan
 * are parallel, all of the scan's cells lie off the map's by the same shift, and together they pull towards where both
 * grids coincide: up to 3 cm in a dense stand, with the period of the cells (doc/study/localisation.md#turned-grids).
 * Between grids that are turned against each other the shift differs from cell to cell, and the pulls cancel.
 */
enum class Grid
{
  Straight,
  Turned,  // by 31 deg about z, 19 deg about x: for scans that are registered to a map with a straight grid
};

/**
 * Sums of points per cell, and the Gaussians of the cells that have enough points.
 *
 * The same points give the same bits in any order, whether added at once or map by map, on any number of threads (see
 * Moments). Cells are in the order of their CellKey, not of a hash table. The edge of a cell is rounded to a multiple
 * of 1/65536 m. Points that are not finite or too far for an index are left out.
 */
class NdtMap
{
 public:
  /** Throws std::invalid_argument if an option is out of its bounds. */
  explicit NdtMap(const NdtOptions&);
  NdtMap(const PointCloud&, const NdtOptions&);
  NdtMap(const std::vector<Eigen::Vector3f>&, const NdtOptions&);
  /** A map of binned(views). In a turned grid, cells() are still in the frame of the points; points cannot be added. */
  NdtMap(const std::vector<View>&, const NdtOptions&, Grid = Grid::Straight);

  /**
   * Adds or removes points of the same frame; only their cells are computed anew. Throws std::invalid_argument if the
   * cell sizes differ, or if the points were never added.
   */
  void add(const BinnedPoints&);
  void remove(const BinnedPoints&);

  /** The same points in cells of `factor` (2 or more) times the edge, from the sums. */
  NdtMap coarser(int factor) const;

  /** Cells with enough points, in the order of their keys. */
  const std::vector<GaussianCell>& cells() const { return cells_; }

  Eigen::Vector3i indexOf(const Eigen::Vector3d& point) const;

  /**
   * Writes to `found` the indices into cells() of the Gaussians among the 1, 7 or 27 cells around `index`, that cell
   * included, and returns how many.
   */
  std::size_t findAround(const Eigen::Vector3i& index, int neighbours, std::uint32_t* found) const;

  std::size_t points() const { return points_; }
  const NdtOptions& options() const { return options_; }

 private:
  /** 4 x 4 x 4 cells: a bit for each that has a Gaussian, and the index in cells_ of the first of them. */
  struct Block
  {
    std::uint64_t cells = 0;
    std::uint32_t first = 0;
  };

  GaussianCell inPointsFrame(GaussianCell) const;
  void combine(const std::vector<Bin>& others, Moments& (Moments::*apply)(const Moments&));
  void requireSameCells(const BinnedPoints&) const;
  bool hasGaussian(const Bin& bin) const { return bin.moments.n >= options_.min_points; }
  double edge() const { return edgeOf(cell_quanta_); }
  void indexBlocks();

  NdtOptions options_;
  std::optional<Eigen::Matrix3d> grid_R_points_;  // none: straight
  std::int64_t cell_quanta_;                      // edge of a cell in Moments::kQuantum
  std::vector<Bin> bins_;                         // sorted by key, also those with too few points
  std::vector<GaussianCell> cells_;
  tsl::robin_map<std::uint64_t, Block, KeyHash> blocks_;  // only looked up, never iterated
  std::size_t points_ = 0;
};

/**
 * A map for each size of cells, in this order; options.cell_size is ignored. Points are binned once into the smallest
 * cells and once more for each size that is not a multiple of it. Throws std::invalid_argument without a size, and as
 * NdtMap does.
 */
std::vector<NdtMap> ndtLevels(const std::vector<Eigen::Vector3f>&, const std::vector<double>& cell_sizes, NdtOptions);
std::vector<NdtMap> ndtLevels(const std::vector<View>&, const std::vector<double>& cell_sizes, NdtOptions, Grid);
}  // namespace scanloom
