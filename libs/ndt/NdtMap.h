#pragma once
#include "core/Field.h"
#include "core/PointCloud.h"
#include "core/Rigid.h"

#include <Eigen/Core>
#include <tsl/robin_map.h>

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
    visit(o.cell_size, Field{"cell_size", "m", "edge of a cell", above(0)});
    visit(o.min_points, Field{"min_points", "", "points that a cell needs to count", atLeast(4)});
    visit(o.min_deviation, Field{"min_deviation", "m", "floor of a cell's standard deviations", above(0)});
  }
};

/** A normal distribution of the points in one cell. */
struct GaussianCell
{
  Eigen::Vector3d mean;
  Eigen::Matrix3d covariance;
  std::uint32_t points = 0;
};

/** Space cut into cubes with a Gaussian each. Cells are listed in a fixed order that no hash decides. */
class NdtMap
{
 public:
  explicit NdtMap(const NdtOptions&);
  NdtMap(const PointCloud&, const NdtOptions&);

  /** Adds the moments of points given in the map's frame. */
  void add(const PointCloud& points_in_map);
  void add(const std::vector<Eigen::Vector3f>& points_in_map);

  /** Cells with enough points, sorted by their index (z, y, x): deterministic. */
  const std::vector<GaussianCell>& cells() const;

  /** The Gaussian of the cell that contains `point`, and of its neighbours; nullptr where there is none. */
  const GaussianCell* cellAt(const Eigen::Vector3i& index) const;
  Eigen::Vector3i indexOf(const Eigen::Vector3d& point) const;

  const NdtOptions& options() const { return options_; }

 private:
  NdtOptions options_;
};
}  // namespace scanloom
