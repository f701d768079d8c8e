/** Points counted into the cells of a grid. */
#pragma once
#include "estimation/ndt/CellKey.h"
#include "estimation/ndt/internal/GaussianCell.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace scanloom
{
/** The points of one cell. */
struct Bin
{
  std::uint64_t key;
  Moments moments;
};

/** Points counted into the cells of a grid: what NdtMap::add() needs of them, in a third of a map's memory. */
struct BinnedPoints
{
  std::int64_t cell_quanta;  // edge of a cell in Moments::kQuantum
  std::vector<Bin> bins;     // sorted by key
};

/** m */
inline double edgeOf(std::int64_t cell_quanta) { return static_cast<double>(cell_quanta) * Moments::kQuantum; }

/** Where a bin of a grid of `edge` (m) begins, m. */
inline Eigen::Vector3d cornerOf(const Bin& bin, double edge) { return edge * CellKey::indexOf(bin.key).cast<double>(); }

/** Mean of the points in a bin of a grid of `edge` (m). */
inline Eigen::Vector3d meanOf(const Bin& bin, double edge) { return meanOf(bin.moments, cornerOf(bin, edge)); }
inline MeanAndCovariance meanAndCovariance(const Bin& bin, double edge)
{
  return meanAndCovariance(bin.moments, cornerOf(bin, edge));
}

/** Positions of points in memory: three arrays, or one of triples. */
struct Coordinates
{
  const float *x, *y, *z;
  std::size_t stride;  // floats from one point to the next
  std::size_t count;

  /** At most `most` points from `begin` on; begin <= count. */
  Coordinates part(std::size_t begin, std::size_t most) const
  {
    const std::size_t skip = begin * stride;
    return {x + skip, y + skip, z + skip, stride, count - begin < most ? count - begin : most};
  }
};

/**
 * Bins sorted by key, as all are here, of a grid into whose frame `grid_R_points` turns the points. Points that are not
 * finite or too far for an index are left out. Parts of the points are counted in parallel; the sums are of integers,
 * so they do not depend on the parts.
 */
std::vector<Bin> countInto(const Coordinates&, std::int64_t cell_quanta,
                           const Eigen::Matrix3d& grid_R_points = Eigen::Matrix3d::Identity());

std::vector<Bin> sumOf(const std::vector<Bin>&, const std::vector<Bin>&);

/** The same points in cells `factor` times as large, from the sums. */
std::vector<Bin> coarserBins(const std::vector<Bin>&, std::int64_t cell_quanta, int factor);

/**
 * If more than `most` bins have `least_points`, bins with fewer than GaussianCell::kMinPointsForCovariance points are
 * removed evenly until `most` are left. Such cells determine the angles where cells are few; where they are many, a
 * part of them is enough.
 */
std::vector<Bin> thinned(const std::vector<Bin>&, int least_points, std::size_t most);

/** A coordinate in units of Moments::kQuantum, without a branch or a library call; |coordinate| < 2^23 m. */
inline std::int64_t quantaOf(double coordinate)
{
  constexpr std::int64_t kBias = std::int64_t{1} << 40;
  return static_cast<std::int64_t>(coordinate * (1 / Moments::kQuantum) + 0.5 + static_cast<double>(kBias)) - kBias;
}

/** The points moved by `shift` (m); they stay in the bin, wherever that takes them. */
inline Bin moved(const Bin& bin, const Eigen::Vector3d& shift)
{
  return {bin.key, bin.moments.about({quantaOf(shift.x()), quantaOf(shift.y()), quantaOf(shift.z())})};
}

/** With `variance` (m^2) along the unit vector `along` added to the points' covariance; their mean stays. */
inline Bin widened(Bin bin, double variance, const Eigen::Vector3d& along)
{
  Moments& m = bin.moments;
  const double sum = static_cast<double>(m.n - 1) * variance / (Moments::kQuantum * Moments::kQuantum);
  const auto product = [&](int i, int j) { return std::llround(sum * along[i] * along[j]); };
  m.xx += product(0, 0), m.xy += product(0, 1), m.xz += product(0, 2);
  m.yy += product(1, 1), m.yz += product(1, 2), m.zz += product(2, 2);
  return bin;
}

/** Division that rounds down, by a multiplication; |a| < 2^50. */
class DividedBy
{
 public:
  explicit DividedBy(std::int64_t divisor) : divisor_(divisor), inverse_(1 / static_cast<double>(divisor)) {}

  std::int64_t operator()(std::int64_t a) const
  {
    const auto quotient = static_cast<std::int64_t>(static_cast<double>(a) * inverse_);  // off by one at most
    const std::int64_t rest = a - quotient * divisor_;
    return quotient - static_cast<std::int64_t>(rest < 0) + static_cast<std::int64_t>(rest >= divisor_);
  }

 private:
  std::int64_t divisor_;
  double inverse_;
};
}  // namespace scanloom
