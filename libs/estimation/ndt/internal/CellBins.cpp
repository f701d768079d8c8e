#include "estimation/ndt/internal/CellBins.h"

#include "estimation/ndt/internal/KeyIndex.h"
#include "estimation/ndt/internal/PointCells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <utility>

namespace scanloom
{
namespace
{
/**
 * The sums of Moments about the cell's centre, two at a time, in double. They are whole numbers without rounding: at
 * most 65536 points, each within 2^18.4 quanta of the centre, keep the sums of products below 2^53.
 */
struct CentredSums
{
  using Two = double __attribute__((vector_size(16)));
  static constexpr std::size_t kMostPoints = 65536;

  Two n_x{}, y_z{}, xx_xy{}, xz_yy{}, yz_zz{};

  void add(double x, double y, double z)
  {
    const Two xy{x, y}, zy{z, y};
    n_x += Two{1, x};
    y_z += Two{y, z};
    xx_xy += Two{x, x} * xy;
    xz_yy += xy * zy;
    yz_zz += Two{y, z} * Two{z, z};
  }

  Moments moments() const
  {
    const auto whole = [](double v) { return static_cast<std::int64_t>(v); };
    return {whole(n_x[0]),   whole(n_x[1]),   whole(y_z[0]),   whole(y_z[1]),   whole(xx_xy[0]),
            whole(xx_xy[1]), whole(xz_yy[0]), whole(xz_yy[1]), whole(yz_zz[0]), whole(yz_zz[1])};
  }
};

struct KeyAndPlace
{
  std::uint64_t key;
  std::uint32_t place;
};

/** Radix sort by the bytes in which the keys differ: half of the time of std::sort. */
std::vector<KeyAndPlace> sortedByKey(std::vector<KeyAndPlace> order)
{
  std::uint64_t differ = 0;
  for (const KeyAndPlace& o : order) differ |= o.key ^ order.front().key;
  std::vector<KeyAndPlace> sorted(order.size());
  for (int shift = 0; shift < 64; shift += 8)
  {
    if ((differ >> shift & 255) == 0) continue;
    std::array<std::uint32_t, 256> next{};
    for (const KeyAndPlace& o : order) ++next[o.key >> shift & 255];
    std::uint32_t end = 0;
    for (std::uint32_t& count : next) count = std::exchange(end, end + count);  // now where each byte begins
    for (const KeyAndPlace& o : order) sorted[next[o.key >> shift & 255]++] = o;
    order.swap(sorted);
  }
  return order;
}

/** Bins in the order of their keys; `moments_of`: by their number in `cells`. */
template <typename MomentsOf>
std::vector<Bin> sortedBins(const KeyIndex& cells, MomentsOf&& moments_of)
{
  std::vector<KeyAndPlace> order;
  order.reserve(cells.keys().size());
  for (const std::uint64_t key : cells.keys()) order.push_back({key, static_cast<std::uint32_t>(order.size())});
  order = sortedByKey(std::move(order));
  std::vector<Bin> bins;
  bins.reserve(order.size());
  for (const auto& [key, place] : order) bins.push_back({key, moments_of(place)});
  return bins;
}

std::vector<Bin> countPart(const Coordinates& points, std::int64_t cell_quanta, const Eigen::Matrix3d& grid_R_points)
{
  KeyIndex cells;
  std::vector<CentredSums> sums;
  for (std::size_t begin = 0; begin < points.count; begin += PointCells::kPoints)
  {
    const Coordinates batch = points.part(begin, PointCells::kPoints);
    const PointCells located = locate(batch, cell_quanta, grid_R_points);
    for (std::size_t i = 0; i < batch.count; ++i)
    {
      if (located.key[i] == PointCells::kNowhere) continue;
      const std::uint32_t cell = cells.placeOf(located.key[i]);
      if (cell == sums.size()) sums.emplace_back();
      sums[cell].add(located.x[i], located.y[i], located.z[i]);
    }
  }
  const Eigen::Matrix<std::int64_t, 3, 1> centre =
      Eigen::Matrix<std::int64_t, 3, 1>::Constant(PointCells::centreOf(cell_quanta));
  return sortedBins(cells, [&](std::uint32_t i) { return sums[i].moments().about(centre); });
}
}  // namespace

std::vector<Bin> countInto(const Coordinates& points, std::int64_t cell_quanta, const Eigen::Matrix3d& grid_R_points)
{
  const std::size_t most = CentredSums::kMostPoints;
  const std::size_t parts = (points.count + most - 1) / most;
  std::vector<std::vector<Bin>> counted(parts);
  tbb::parallel_for(std::size_t{0}, parts,
                    [&](std::size_t i)
                    { counted[i] = countPart(points.part(i * most, most), cell_quanta, grid_R_points); });
  std::vector<Bin> all;
  for (std::vector<Bin>& part : counted) all = all.empty() ? std::move(part) : sumOf(all, part);
  return all;
}

std::vector<Bin> sumOf(const std::vector<Bin>& a, const std::vector<Bin>& b)
{
  std::vector<Bin> sum;
  sum.reserve(a.size() + b.size());
  auto from_b = b.cbegin();
  for (const Bin& bin : a)
  {
    while (from_b != b.cend() && from_b->key < bin.key) sum.push_back(*from_b++);
    sum.push_back(bin);
    if (from_b != b.cend() && from_b->key == bin.key) sum.back().moments += (from_b++)->moments;
  }
  sum.insert(sum.end(), from_b, b.cend());
  return sum;
}

std::vector<Bin> coarserBins(const std::vector<Bin>& fine, std::int64_t cell_quanta, int factor)
{
  const DividedBy parentOf(factor);
  KeyIndex parents;
  std::vector<Moments> sums;
  for (const Bin& bin : fine)
  {
    const auto child = CellKey::indexOf(bin.key);
    const Eigen::Matrix<std::int64_t, 3, 1> parent(parentOf(child.x()), parentOf(child.y()), parentOf(child.z()));
    const std::uint32_t place = parents.placeOf(CellKey::of(parent.x(), parent.y(), parent.z()));
    if (place == sums.size()) sums.emplace_back();
    sums[place] += bin.moments.about(cell_quanta * (child - factor * parent));
  }
  return sortedBins(parents, [&](std::uint32_t i) { return sums[i]; });
}

std::vector<Bin> thinned(const std::vector<Bin>& bins, int least_points, std::size_t most)
{
  const auto counts = [&](const Bin& bin) { return bin.moments.n >= least_points; };
  const auto hasFew = [&](const Bin& bin)
  { return counts(bin) && bin.moments.n < GaussianCell::kMinPointsForCovariance; };
  const auto all = static_cast<std::size_t>(std::count_if(bins.begin(), bins.end(), counts));
  const auto few = static_cast<std::size_t>(std::count_if(bins.begin(), bins.end(), hasFew));
  if (all <= most) return bins;

  const std::size_t room = most - std::min(most, all - few);
  std::vector<Bin> kept;
  std::size_t place = 0;  // among those with few points
  for (const Bin& bin : bins)
  {
    const bool fits = !hasFew(bin) || (place + 1) * room / few != place * room / few;
    if (hasFew(bin)) ++place;
    if (fits) kept.push_back(bin);
  }
  return kept;
}
}  // namespace scanloom
