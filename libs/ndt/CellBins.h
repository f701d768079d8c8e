/** Points counted into the cells of a grid. */
#pragma once
#include "ndt/CellKey.h"
#include "ndt/GaussianCell.h"

#include <cstddef>
#include <vector>

namespace scanloom
{
struct Bin
{
  std::uint64_t key;
  Moments moments;
};

struct CellBins
{
  std::vector<Bin> bins;     // sorted by key
  std::size_t left_out = 0;  // points that are not finite or too far for an index
};

/** Positions of points, wherever they lie: three arrays, or one of triples. */
struct Coordinates
{
  const float *x, *y, *z;
  std::size_t stride;  // floats from one point to the next
  std::size_t count;

  /** At most `most` of the points from `begin` on, which must not be behind the last. */
  Coordinates part(std::size_t begin, std::size_t most) const
  {
    const std::size_t skip = begin * stride;
    return {x + skip, y + skip, z + skip, stride, count - begin < most ? count - begin : most};
  }
};

/** Parts of the points are counted in parallel; sums of integers are the same for any parts. */
CellBins countInto(const Coordinates&, std::int64_t cell_quanta);

/** The points of both. */
std::vector<Bin> sumOf(const std::vector<Bin>&, const std::vector<Bin>&);

/** The same points in cells `factor` times as large: no point is looked at again. */
std::vector<Bin> coarserBins(const std::vector<Bin>&, std::int64_t cell_quanta, int factor);

/**
 * Without some of those with fewer than GaussianCell::kTellsItsSpread points, evenly, if more than `most` bins have
 * `least_points`. Cells of few points hold the angles where there are few cells; of many, a share does.
 */
std::vector<Bin> thinned(const std::vector<Bin>&, int least_points, std::size_t most);

/** A coordinate in Moments::kQuantum, without a branch or a library call: |coordinate| < 2^23 m. */
inline std::int64_t quantaOf(double coordinate)
{
  constexpr std::int64_t kBias = std::int64_t{1} << 40;
  return static_cast<std::int64_t>(coordinate * (1 / Moments::kQuantum) + 0.5 + static_cast<double>(kBias)) - kBias;
}

/** Division that rounds down, by a multiplication: |a| < 2^50. */
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
