#include "ndt/NdtMap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace scanloom
{
namespace
{
constexpr int kBitsPerAxis = 21;
constexpr std::int64_t kIndexLimit = std::int64_t{1} << (kBitsPerAxis - 1);

using Quanta = Eigen::Matrix<std::int64_t, 3, 1>;  // a position in Moments::kQuantum

bool fits(std::int64_t index) { return index >= -kIndexLimit && index < kIndexLimit; }

/** Keys sort as (z, y, x). */
std::uint64_t keyOf(std::int64_t x, std::int64_t y, std::int64_t z)
{
  const auto biased = [](std::int64_t index) { return static_cast<std::uint64_t>(index + kIndexLimit); };
  return (biased(z) << (2 * kBitsPerAxis)) | (biased(y) << kBitsPerAxis) | biased(x);
}

Eigen::Vector3d indexOfKey(std::uint64_t key)
{
  const auto axis = [key](int i)
  {
    return static_cast<double>(static_cast<std::int64_t>((key >> (i * kBitsPerAxis)) & (2 * kIndexLimit - 1)) -
                               kIndexLimit);
  };
  return {axis(0), axis(1), axis(2)};
}

/** Rounds down without a branch or a library call, as long as |value| < 2^40. */
std::int64_t floorToInt(double value)
{
  constexpr std::int64_t kBias = std::int64_t{1} << 40;
  return static_cast<std::int64_t>(value + static_cast<double>(kBias)) - kBias;
}

std::int64_t quantaOf(double coordinate) { return floorToInt(coordinate * (1 / Moments::kQuantum) + 0.5); }

std::int64_t cellOf(std::int64_t quanta, std::int64_t cell_quanta)
{
  return quanta >= 0 ? quanta / cell_quanta : (quanta + 1) / cell_quanta - 1;
}

void check(const NdtOptions& options)
{
  NdtOptions::fields(
      options,
      [](const auto& value, const Field& f)
      {
        const double v = static_cast<double>(value);
        if (v >= f.bounds.lowest && v <= f.bounds.highest && !(f.bounds.lowest_excluded && v == f.bounds.lowest))
          return;
        throw std::invalid_argument(fmt::format(
            "NdtOptions: {} = {} {}: must be {} {}{}", f.name, v, f.unit,
            f.bounds.lowest_excluded ? "above" : "at least", f.bounds.lowest,
            std::isfinite(f.bounds.highest) ? fmt::format(" and at most {}", f.bounds.highest) : std::string()));
      });
}
}  // namespace

NdtMap::NdtMap(const NdtOptions& options)
  : options_((check(options), options)), cell_quanta_(std::llround(options.cell_size / Moments::kQuantum))
{
}

NdtMap::NdtMap(const PointCloud& points, const NdtOptions& options) : NdtMap(options) { add(points); }

NdtMap::NdtMap(const std::vector<Eigen::Vector3f>& points, const NdtOptions& options) : NdtMap(options) { add(points); }

void NdtMap::add(const PointCloud& cloud)
{
  addPoints(cloud.size(), [&cloud](std::size_t i) { return cloud.position(i); });
}

void NdtMap::add(const std::vector<Eigen::Vector3f>& points)
{
  addPoints(points.size(), [&points](std::size_t i) -> const Eigen::Vector3f& { return points[i]; });
}

template <typename PositionOf>
void NdtMap::addPoints(std::size_t count, PositionOf&& positionOf)
{
  const auto reach = static_cast<float>((kIndexLimit - 1) * static_cast<double>(cell_quanta_) * Moments::kQuantum);
  const auto edge = static_cast<std::uint64_t>(cell_quanta_);
  std::vector<Bin> bins;
  tsl::robin_map<std::uint64_t, std::uint32_t, KeyHash> bin_of_key;
  std::uint32_t bin = 0;
  Quanta corner = Quanta::Constant(std::numeric_limits<std::int64_t>::max() / 2);  // of that bin

  for (std::size_t i = 0; i < count; ++i)
  {
    const Eigen::Vector3f p = positionOf(i);
    if (!(std::abs(p.x()) < reach && std::abs(p.y()) < reach && std::abs(p.z()) < reach))  // also what is not finite
    {
      ++points_left_out_;
      continue;
    }
    const Quanta point(quantaOf(p.x()), quantaOf(p.y()), quantaOf(p.z()));
    const auto sameCell = [edge, &corner, &point](int k)
    { return static_cast<std::uint64_t>(point[k] - corner[k]) < edge; };
    if (!(sameCell(0) && sameCell(1) && sameCell(2)))  // neighbours in a column mostly share a cell
    {
      const Quanta cell(cellOf(point[0], cell_quanta_), cellOf(point[1], cell_quanta_), cellOf(point[2], cell_quanta_));
      corner = cell * cell_quanta_;
      const std::uint64_t key = keyOf(cell.x(), cell.y(), cell.z());
      const auto [found, is_new] = bin_of_key.try_emplace(key, static_cast<std::uint32_t>(bins.size()));
      if (is_new) bins.push_back({key, {}});
      bin = found->second;
    }
    bins[bin].moments.add(point[0] - corner[0], point[1] - corner[1], point[2] - corner[2]);
  }
  std::sort(bins.begin(), bins.end(), [](const Bin& a, const Bin& b) { return a.key < b.key; });
  combine(bins, [](Moments& a, const Moments& b) { a += b; });
}

void NdtMap::add(const NdtMap& other)
{
  requireSameCells(other);
  combine(other.bins_, [](Moments& a, const Moments& b) { a += b; });
}

void NdtMap::remove(const NdtMap& other)
{
  requireSameCells(other);
  combine(other.bins_, [](Moments& a, const Moments& b) { a -= b; });
}

template <typename Combine>
void NdtMap::combine(const std::vector<Bin>& others, Combine&& apply)
{
  std::vector<Bin> combined;
  combined.reserve(bins_.size() + others.size());
  auto mine = bins_.cbegin();
  for (const Bin& other : others)
  {
    while (mine != bins_.cend() && mine->key < other.key) combined.push_back(*mine++);
    Bin sum = mine != bins_.cend() && mine->key == other.key ? *mine++ : Bin{other.key, {}};
    apply(sum.moments, other.moments);
    if (sum.moments.n < 0) throw std::invalid_argument("NdtMap::remove: these points were never added");
    if (sum.moments.n > 0) combined.push_back(sum);
  }
  combined.insert(combined.end(), mine, bins_.cend());
  bins_ = std::move(combined);
  computeGaussians();
}

void NdtMap::requireSameCells(const NdtMap& other) const
{
  if (cell_quanta_ == other.cell_quanta_) return;
  throw std::invalid_argument(
      fmt::format("NdtMap: cells of {} m do not add to cells of {} m: give both maps one cell_size",
                  other.options_.cell_size, options_.cell_size));
}

void NdtMap::computeGaussians()
{
  const double edge = static_cast<double>(cell_quanta_) * Moments::kQuantum;
  cells_.clear();
  cell_of_key_.clear();
  cells_.reserve(bins_.size());
  cell_of_key_.reserve(bins_.size());
  points_ = 0;
  for (const Bin& bin : bins_)
  {
    points_ += static_cast<std::size_t>(bin.moments.n);
    if (bin.moments.n < options_.min_points) continue;
    cell_of_key_.emplace(bin.key, static_cast<std::uint32_t>(cells_.size()));
    cells_.push_back(gaussianOf(bin.moments, edge * indexOfKey(bin.key), options_.min_deviation));
  }
}

const GaussianCell* NdtMap::cellAt(const Eigen::Vector3i& index) const
{
  if (!fits(index.x()) || !fits(index.y()) || !fits(index.z())) return nullptr;
  const auto found = cell_of_key_.find(keyOf(index.x(), index.y(), index.z()));
  return found == cell_of_key_.end() ? nullptr : &cells_[found->second];
}

Eigen::Vector3i NdtMap::indexOf(const Eigen::Vector3d& point) const
{
  const double reach = static_cast<double>((kIndexLimit - 1) * cell_quanta_) * Moments::kQuantum;
  const auto index = [this, reach](double coordinate)
  {
    if (!(std::abs(coordinate) < reach)) return static_cast<int>(kIndexLimit);  // a cell that no map has
    return static_cast<int>(cellOf(quantaOf(coordinate), cell_quanta_));
  };
  return {index(point.x()), index(point.y()), index(point.z())};
}
}  // namespace scanloom
