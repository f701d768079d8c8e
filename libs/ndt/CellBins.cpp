#include "ndt/CellBins.h"

#include <tbb/parallel_for.h>
#include <tsl/robin_map.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scanloom
{
namespace
{
constexpr std::size_t kPart = 65536;  // points: a multiple of what a thread should not be woken for

bool byKey(const Bin& a, const Bin& b) { return a.key < b.key; }

/** Finds the bin of a cell, new or not. */
class BinTable
{
 public:
  BinTable()
  {
    constexpr std::size_t kUsual = 4096;  // cells of a scan's part
    bins_.reserve(kUsual);
    bin_of_key_.reserve(kUsual);
  }

  Moments& operator[](std::uint64_t key)
  {
    const auto [found, is_new] = bin_of_key_.try_emplace(key, static_cast<std::uint32_t>(bins_.size()));
    if (is_new) bins_.push_back({key, {}});
    return bins_[found->second].moments;
  }

  std::vector<Bin> sorted()
  {
    std::sort(bins_.begin(), bins_.end(), byKey);
    return std::move(bins_);
  }

 private:
  std::vector<Bin> bins_;
  tsl::robin_map<std::uint64_t, std::uint32_t, KeyHash> bin_of_key_;
};

CellBins countPart(const Coordinates& points, std::size_t begin, std::size_t end, std::int64_t cell_quanta)
{
  const auto reach = static_cast<float>(static_cast<double>((CellKey::kLimit - 1) * cell_quanta) * Moments::kQuantum);
  const auto edge = static_cast<std::uint64_t>(cell_quanta);
  const DividedBy cellOf(cell_quanta);
  BinTable table;
  CellBins result;
  Moments run;            // of neighbours in a column, which mostly share a cell
  std::uint64_t key = 0;  // of that cell
  constexpr std::int64_t kNowhere = std::numeric_limits<std::int64_t>::max() / 2;
  std::int64_t corner_x = kNowhere, corner_y = kNowhere, corner_z = kNowhere;  // of that cell
  for (std::size_t i = begin; i < end; ++i)
  {
    const float fx = points.x[i * points.stride], fy = points.y[i * points.stride], fz = points.z[i * points.stride];
    if (!(std::abs(fx) < reach && std::abs(fy) < reach && std::abs(fz) < reach))  // also what is not finite
    {
      ++result.left_out;
      continue;
    }
    const std::int64_t x = quantaOf(fx), y = quantaOf(fy), z = quantaOf(fz);
    const auto isIn = [edge](std::int64_t q, std::int64_t corner)
    { return static_cast<std::uint64_t>(q - corner) < edge; };
    if (!(isIn(x, corner_x) && isIn(y, corner_y) && isIn(z, corner_z)))
    {
      if (run.n > 0) table[key] += run;
      run = {};
      const std::int64_t cell_x = cellOf(x), cell_y = cellOf(y), cell_z = cellOf(z);
      corner_x = cell_x * cell_quanta, corner_y = cell_y * cell_quanta, corner_z = cell_z * cell_quanta;
      key = CellKey::of(cell_x, cell_y, cell_z);
    }
    run.add(x - corner_x, y - corner_y, z - corner_z);
  }
  if (run.n > 0) table[key] += run;
  result.bins = table.sorted();
  return result;
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
}  // namespace

CellBins countInto(const Coordinates& points, std::int64_t cell_quanta)
{
  const std::size_t parts = (points.count + kPart - 1) / kPart;
  std::vector<CellBins> counted(parts);
  tbb::parallel_for(std::size_t{0}, parts,
                    [&](std::size_t i) {
                      counted[i] = countPart(points, i * kPart, std::min((i + 1) * kPart, points.count), cell_quanta);
                    });
  CellBins all;
  for (CellBins& part : counted)
  {
    all.bins = all.bins.empty() ? std::move(part.bins) : sumOf(all.bins, part.bins);
    all.left_out += part.left_out;
  }
  return all;
}

std::vector<Bin> coarserBins(const std::vector<Bin>& fine, std::int64_t cell_quanta, int factor)
{
  const DividedBy parentOf(factor);
  BinTable table;
  for (const Bin& bin : fine)
  {
    const auto child = CellKey::indexOf(bin.key);
    const Eigen::Matrix<std::int64_t, 3, 1> parent(parentOf(child.x()), parentOf(child.y()), parentOf(child.z()));
    table[CellKey::of(parent.x(), parent.y(), parent.z())] +=
        bin.moments.about(cell_quanta * (child - factor * parent));
  }
  return table.sorted();
}
}  // namespace scanloom
