#include "estimation/ndt/internal/PointCells.h"

#include "estimation/ndt/internal/PairLanes.h"

#include <cstring>

namespace scanloom
{
namespace
{
// No comparisons: GCC splits those of vectors before it knows the registers of a function's target.
using Bits = std::uint64_t __attribute__((vector_size(8 * TargetBlock::kLanes)));

struct Axis
{
  Lanes place;  // whole quanta from the cell's centre
  Bits biased;  // index of the cell, see CellKey
  Bits fits;    // in its highest bit
};

struct Cells
{
  double edge, inverse_edge, centre;
  std::uint64_t bits_of_reach;
  double turn[3][3];  // from points to the grid
};

SCANLOOM_INLINE Axis along(const Lanes& v, const Cells& cells)
{
  const Lanes quanta = (v * (1 / Moments::kQuantum) + kRound) - kRound;

  // Half a quantum off a boundary, a quotient is farther from a whole number (2^-21) than its rounding error (2^-31).
  const Lanes shifted = ((quanta + 0.5) * cells.inverse_edge - 0.5) + kRound;
  Axis axis;
  axis.place = quanta - (shifted - kRound) * cells.edge - cells.centre;
  std::memcpy(&axis.biased, &shifted, sizeof shifted);
  axis.biased += static_cast<std::uint64_t>(CellKey::kLimit) - kBitsOfRound;

  // Bits of positive numbers have the order of the numbers; those of infinity and NaN are above them.
  Bits magnitude;
  std::memcpy(&magnitude, &v, sizeof v);
  axis.fits = (magnitude << 1 >> 1) - cells.bits_of_reach;
  return axis;
}

// The buffer is changed in place: a second one of 16 kB would push the first one out of the cache.
SCANLOOM_INLINE void locateAll(std::size_t count, const Cells& cells, PointCells& located)
{
  const auto& turn = cells.turn;
  for (std::size_t i = 0; i < count; i += TargetBlock::kLanes)
  {
    Lanes px, py, pz;
    std::memcpy(&px, located.x + i, sizeof px);
    std::memcpy(&py, located.y + i, sizeof py);
    std::memcpy(&pz, located.z + i, sizeof pz);
    const Axis x = along(turn[0][0] * px + turn[0][1] * py + turn[0][2] * pz, cells);
    const Axis y = along(turn[1][0] * px + turn[1][1] * py + turn[1][2] * pz, cells);
    const Axis z = along(turn[2][0] * px + turn[2][1] * py + turn[2][2] * pz, cells);
    std::memcpy(located.x + i, &x.place, sizeof x.place);
    std::memcpy(located.y + i, &y.place, sizeof y.place);
    std::memcpy(located.z + i, &z.place, sizeof z.place);
    Bits key;
    CellKey::compose(x.biased, y.biased, z.biased, key);
    key |= ((x.fits & y.fits & z.fits) >> 63) - 1;
    std::memcpy(located.key + i, &key, sizeof key);
  }
}

/** The points in double. Separate from the arithmetic: a load that spans several recent stores has to wait for them. */
PointCells widened(const Coordinates& points)
{
  PointCells located;
  std::size_t i = 0;
  for (; i < points.count; ++i)
  {
    located.x[i] = static_cast<double>(points.x[i * points.stride]);
    located.y[i] = static_cast<double>(points.y[i * points.stride]);
    located.z[i] = static_cast<double>(points.z[i * points.stride]);
  }
  for (; i % TargetBlock::kLanes != 0; ++i) located.x[i] = located.y[i] = located.z[i] = 0;
  return located;
}

void locatePortable(std::size_t count, const Cells& cells, PointCells& located) { locateAll(count, cells, located); }

SCANLOOM_AVX2 void locateAvx2(std::size_t count, const Cells& cells, PointCells& located)
{
  locateAll(count, cells, located);
}

SCANLOOM_AVX512 void locateAvx512(std::size_t count, const Cells& cells, PointCells& located)
{
  locateAll(count, cells, located);
}
}  // namespace

PointCells locate(const Coordinates& points, std::int64_t cell_quanta, const Eigen::Matrix3d& grid_R_points,
                  Kernel kernel)
{
  const auto edge = static_cast<double>(cell_quanta);
  const double reach = static_cast<double>(CellKey::kLimit - 1) * edge * Moments::kQuantum;
  Cells cells{edge, 1 / edge, static_cast<double>(PointCells::centreOf(cell_quanta)), 0, {}};
  std::memcpy(&cells.bits_of_reach, &reach, sizeof reach);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) cells.turn[row][column] = grid_R_points(row, column);
  PointCells located = widened(points);
  switch (kernel)
  {
    case Kernel::Portable:
      locatePortable(points.count, cells, located);
      break;
    case Kernel::Avx2:
      locateAvx2(points.count, cells, located);
      break;
    case Kernel::Avx512:
      locateAvx512(points.count, cells, located);
      break;
  }
  return located;
}
}  // namespace scanloom
