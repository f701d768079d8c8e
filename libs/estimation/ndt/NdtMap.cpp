#include "estimation/ndt/NdtMap.h"

#include "base/core/forAll.h"
#include "estimation/ndt/internal/RingSpread.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace scanloom
{
namespace
{
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

Coordinates coordinatesOf(const std::vector<Eigen::Vector3f>& points)
{
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  if (points.empty()) return {nullptr, nullptr, nullptr, 3, 0};
  const float* first = points.front().data();
  return {first, first + 1, first + 2, 3, points.size()};
}

Coordinates coordinatesOf(const PointCloud& cloud)
{
  return {cloud.x.data(), cloud.y.data(), cloud.z.data(), 1, cloud.size()};
}

std::int64_t quantaOfCell(const NdtOptions& options) { return std::llround(options.cell_size / Moments::kQuantum); }

std::vector<Bin> thinned(std::vector<Bin> bins, const NdtOptions& options)
{
  if (options.max_cells == 0) return bins;
  return thinned(bins, options.min_points, static_cast<std::size_t>(options.max_cells));
}

/** How many are set. Compilers call a function for it where the processor may have no instruction. */
std::uint32_t bitsOf(std::uint64_t v)
{
  v -= v >> 1 & 0x5555555555555555;
  v = (v & 0x3333333333333333) + (v >> 2 & 0x3333333333333333);
  v = (v + (v >> 4)) & 0x0f0f0f0f0f0f0f0f;
  return static_cast<std::uint32_t>(v * 0x0101010101010101 >> 56);
}

/** The part of one axis that lies in one block: the cells from -1 to 1 around the centre, and the centre alone. */
struct AxisInBlock
{
  std::uint64_t block = 0;   // index of the block along the axis
  std::uint64_t around = 0;  // bits of a block's 64 cells
  std::uint64_t centre = 0;
};

struct SplitAxis
{
  std::array<AxisInBlock, 2> parts;
  std::size_t count = 0;
};

/** `spread`: from the four indices of an axis to bits of the 64 cells. */
template <typename Spread>
SplitAxis splitAxis(std::int64_t index, Spread&& spread)
{
  SplitAxis split;
  for (std::int64_t i = index - 1; i <= index + 1; ++i)
  {
    const std::uint64_t biased = CellKey::biased(i), block = biased >> 2;
    if (split.count == 0 || split.parts[split.count - 1].block != block) split.parts[split.count++] = {block, 0, 0};
    AxisInBlock& part = split.parts[split.count - 1];
    part.around |= spread(biased & 3);
    if (i == index) part.centre = spread(biased & 3);
  }
  return split;
}

/** Of the block of each bin. */
std::vector<SurfaceOfBlock> surfacesOf(const std::vector<Bin>& bins, double edge)
{
  std::vector<SurfaceOfBlock> surfaces(bins.size());
  for (std::size_t first = 0, last = 0; first < bins.size(); first = last)
  {
    const auto isOfBlock = [&](const Bin& bin)
    { return bin.key >> CellKey::kCellBits == bins[first].key >> CellKey::kCellBits; };
    while (last < bins.size() && isOfBlock(bins[last])) ++last;
    std::fill(surfaces.begin() + static_cast<std::ptrdiff_t>(first),
              surfaces.begin() + static_cast<std::ptrdiff_t>(last), surfaceOf(&bins[first], bins.data() + last, edge));
  }
  return surfaces;
}

/** Corrected as the view says, and widened across its rings. */
std::vector<Bin> asSeen(std::vector<Bin> bins, const View& view, const Sight& sight,
                        const Eigen::Matrix3d& grid_R_points)
{
  const CellCorrections& corrections = view.corrections;
  if (corrections.of_all) bins = corrections.of_all(std::move(bins), sight);
  std::optional<Rings> rings = view.rings;
  if (rings) rings->axis = grid_R_points * rings->axis;
  if (!rings && !corrections.shift_of) return bins;
  const std::vector<SurfaceOfBlock> surfaces = rings ? surfacesOf(bins, sight.edge) : std::vector<SurfaceOfBlock>{};
  forAll(bins.size(), 256,
         [&](std::size_t i)
         {
           // A few points in the corner of a cell are where a ring is, and too few to be widened.
           if (rings && bins[i].moments.n < GaussianCell::kMinPointsForCovariance && surfaces[i].isKnown())
             bins[i].moments = {};
           if (bins[i].moments.n < 2) return;
           MeanAndCovariance seen = meanAndCovariance(bins[i], sight.edge);
           if (corrections.shift_of && bins[i].moments.n >= sight.least_points)
           {
             bins[i] = moved(bins[i], corrections.shift_of(seen, sight));
             seen.mean = meanOf(bins[i], sight.edge);  // the covariance stays
           }
           if (rings) bins[i] = widenedAcrossRings(bins[i], seen, sight, *rings, surfaces[i]);
         });
  const auto isEmpty = [](const Bin& bin) { return bin.moments.n == 0; };
  bins.erase(std::remove_if(bins.begin(), bins.end(), isEmpty), bins.end());
  return bins;
}

BinnedPoints binned(const std::vector<View>& views, const Eigen::Matrix3d& grid_R_points, const NdtOptions& options)
{
  const std::int64_t cell_quanta = quantaOfCell(options);
  const int least_points = std::max(options.min_points, GaussianCell::kMinPointsForCovariance);
  std::vector<std::vector<Bin>> counted(views.size());
  tbb::parallel_for(
      std::size_t{0}, views.size(),
      [&](std::size_t i)
      {
        counted[i] = countInto(coordinatesOf(views[i].points), cell_quanta, grid_R_points);
        if (!views[i].viewpoint) return;
        const Sight sight{edgeOf(cell_quanta), grid_R_points * *views[i].viewpoint, grid_R_points.col(2), least_points};
        counted[i] = asSeen(std::move(counted[i]), views[i], sight, grid_R_points);
      });
  std::vector<Bin> all;
  for (std::vector<Bin>& bins : counted) all = all.empty() ? std::move(bins) : sumOf(all, bins);
  return {cell_quanta, thinned(std::move(all), options)};
}

/** Small whole numbers, so that every processor has the same rotation; no axis of one grid is along one of the other.
 */
Eigen::Matrix3d turnedFromPoints() { return Eigen::Quaterniond(18, 3, 1, 5).normalized().toRotationMatrix(); }
}  // namespace

BinnedPoints binned(const std::vector<View>& views, const NdtOptions& options)
{
  check(options);
  return binned(views, Eigen::Matrix3d::Identity(), options);
}

NdtMap::NdtMap(const NdtOptions& options) : options_((check(options), options)), cell_quanta_(quantaOfCell(options)) {}

NdtMap::NdtMap(const PointCloud& points, const NdtOptions& options) : NdtMap(options)
{
  combine(thinned(countInto(coordinatesOf(points), cell_quanta_), options), &Moments::operator+=);
}

NdtMap::NdtMap(const std::vector<Eigen::Vector3f>& points, const NdtOptions& options) : NdtMap(options)
{
  combine(thinned(countInto(coordinatesOf(points), cell_quanta_), options), &Moments::operator+=);
}

NdtMap::NdtMap(const std::vector<View>& views, const NdtOptions& options, Grid grid) : NdtMap(options)
{
  if (grid == Grid::Turned) grid_R_points_ = turnedFromPoints();
  const Eigen::Matrix3d grid_R_points = grid_R_points_.value_or(Eigen::Matrix3d::Identity());
  combine(binned(views, grid_R_points, options).bins, &Moments::operator+=);
}

void NdtMap::add(const BinnedPoints& points)
{
  requireSameCells(points);
  combine(points.bins, &Moments::operator+=);
}

void NdtMap::remove(const BinnedPoints& points)
{
  requireSameCells(points);
  combine(points.bins, &Moments::operator-=);
}

GaussianCell NdtMap::inPointsFrame(GaussianCell cell) const
{
  if (!grid_R_points_) return cell;
  const Eigen::Matrix3d points_R_grid = grid_R_points_->transpose();
  const auto turned = [&](const Eigen::Matrix3d& m) -> Eigen::Matrix3d { return points_R_grid * m * *grid_R_points_; };
  cell.mean = points_R_grid * cell.mean;
  cell.covariance = turned(cell.covariance);
  cell.structure = turned(cell.structure);
  return cell;
}

NdtMap NdtMap::coarser(int factor) const
{
  NdtOptions options = options_;
  options.cell_size *= factor;
  check(options);
  NdtMap coarse(options);
  coarse.grid_R_points_ = grid_R_points_;
  coarse.cell_quanta_ = cell_quanta_ * factor;
  coarse.combine(coarserBins(bins_, cell_quanta_, factor), &Moments::operator+=);
  return coarse;
}

void NdtMap::combine(const std::vector<Bin>& others, Moments& (Moments::*apply)(const Moments&))
{
  std::vector<Bin> bins;
  std::vector<GaussianCell> cells;
  bins.reserve(bins_.size() + others.size());
  cells.reserve(cells_.size() + others.size());
  struct Changed
  {
    std::size_t bin, cell;
  };
  std::vector<Changed> changed;
  auto mine = bins_.cbegin();
  auto my_cell = cells_.cbegin();
  const auto keep = [&](const Bin& bin)
  {
    bins.push_back(bin);
    if (hasGaussian(bin)) cells.push_back(*my_cell++);
  };
  for (const Bin& other : others)
  {
    while (mine != bins_.cend() && mine->key < other.key) keep(*mine++);
    Bin sum{other.key, {}};
    if (mine != bins_.cend() && mine->key == other.key)
    {
      if (hasGaussian(*mine)) ++my_cell;
      sum = *mine++;
    }
    const std::int64_t before = sum.moments.n;
    (sum.moments.*apply)(other.moments);
    if (sum.moments.n < 0) throw std::invalid_argument("NdtMap::remove: these points were never added");
    points_ = static_cast<std::size_t>(static_cast<std::int64_t>(points_) + sum.moments.n - before);
    if (sum.moments.n == 0) continue;
    bins.push_back(sum);
    if (!hasGaussian(sum)) continue;
    changed.push_back({bins.size() - 1, cells.size()});
    cells.emplace_back();
  }
  while (mine != bins_.cend()) keep(*mine++);
  const std::size_t grain = 16;  // groups of Gaussians, about 20 us
  forAll((changed.size() + kGaussiansAtOnce - 1) / kGaussiansAtOnce, grain,
         [&](std::size_t group)
         {
           const std::size_t first = group * kGaussiansAtOnce;
           const std::size_t count = std::min(kGaussiansAtOnce, changed.size() - first);
           std::array<CellPoints, kGaussiansAtOnce> points;
           for (std::size_t i = 0; i < count; ++i)
           {
             const Bin& bin = bins[changed[first + i].bin];
             points[i] = {bin.moments, cornerOf(bin, edge())};
           }
           const auto gaussians = gaussiansOf(points.data(), count, edge(), options_.min_deviation);
           for (std::size_t i = 0; i < count; ++i) cells[changed[first + i].cell] = inPointsFrame(gaussians[i]);
         });
  bins_ = std::move(bins);
  cells_ = std::move(cells);
  indexBlocks();
}

void NdtMap::requireSameCells(const BinnedPoints& points) const
{
  if (grid_R_points_) throw std::invalid_argument("NdtMap: points cannot be added to a turned grid, or removed");
  if (cell_quanta_ == points.cell_quanta) return;
  throw std::invalid_argument(fmt::format("NdtMap: cells of {} m do not add to cells of {} m: give both one cell_size",
                                          edgeOf(points.cell_quanta), options_.cell_size));
}

/** The cells of a block (CellKey) follow each other in bins_, because the higher bits of their keys are the block's. */
void NdtMap::indexBlocks()
{
  blocks_.clear();
  std::uint32_t cell = 0;
  Block block;
  std::uint64_t key = 0;
  const auto finish = [&]
  {
    if (block.cells != 0) blocks_.emplace(key, block);
  };
  for (const Bin& bin : bins_)
  {
    if (!hasGaussian(bin)) continue;
    if (block.cells == 0 || bin.key >> CellKey::kCellBits != key)
    {
      finish();
      key = bin.key >> CellKey::kCellBits;
      block = {0, cell};
    }
    block.cells |= std::uint64_t{1} << (bin.key & 63);
    ++cell;
  }
  finish();
}

std::size_t NdtMap::findAround(const Eigen::Vector3i& index, int neighbours, std::uint32_t* found) const
{
  // Neighbours of a cell at the border have no index; such cells are too far away to matter.
  if (!CellKey::fits(index.minCoeff() - std::int64_t{1}) || !CellKey::fits(index.maxCoeff() + std::int64_t{1}))
    return 0;
  const SplitAxis along_x = splitAxis(index.x(), [](std::uint64_t i) { return 0x1111111111111111U << i; });
  const SplitAxis along_y = splitAxis(index.y(), [](std::uint64_t i) { return 0x000f000f000f000fU << (4 * i); });
  const SplitAxis along_z = splitAxis(index.z(), [](std::uint64_t i) { return std::uint64_t{0xffff} << (16 * i); });
  std::uint32_t* end = found;
  for (std::size_t k = 0; k < along_z.count; ++k)
    for (std::size_t j = 0; j < along_y.count; ++j)
      for (std::size_t i = 0; i < along_x.count; ++i)
      {
        const AxisInBlock &x = along_x.parts[i], &y = along_y.parts[j], &z = along_z.parts[k];
        const std::uint64_t wanted =
            neighbours == 27 ? x.around & y.around & z.around
            : neighbours == 7
                ? (x.around & y.centre & z.centre) | (x.centre & y.around & z.centre) | (x.centre & y.centre & z.around)
                : x.centre & y.centre & z.centre;
        if (wanted == 0) continue;
        const auto block = blocks_.find(CellKey::blockOf(x.block, y.block, z.block));
        if (block == blocks_.end()) continue;
        const std::uint64_t cells = block->second.cells;
        for (std::uint64_t left = cells & wanted; left != 0; left &= left - 1)
        {
          const std::uint64_t before = (left & -left) - 1;
          *end++ = block->second.first + bitsOf(cells & before);
        }
      }
  return static_cast<std::size_t>(end - found);
}

Eigen::Vector3i NdtMap::indexOf(const Eigen::Vector3d& in_points_frame) const
{
  const Eigen::Vector3d point = grid_R_points_ ? *grid_R_points_ * in_points_frame : in_points_frame;
  const double reach = static_cast<double>((CellKey::kLimit - 1) * cell_quanta_) * Moments::kQuantum;
  const DividedBy cellOf(cell_quanta_);
  const auto index = [&](double coordinate)
  {
    if (!(std::abs(coordinate) < reach)) return static_cast<int>(CellKey::kLimit);  // the index of no cell
    return static_cast<int>(cellOf(quantaOf(coordinate)));
  };
  return {index(point.x()), index(point.y()), index(point.z())};
}

namespace
{
template <typename MapOfCells>
std::vector<NdtMap> levelsOf(const MapOfCells& mapOf, const std::vector<double>& cell_sizes, NdtOptions options)
{
  if (cell_sizes.empty()) throw std::invalid_argument("ndtLevels: at least one size of cells is needed");
  options.cell_size = *std::min_element(cell_sizes.begin(), cell_sizes.end());
  const NdtMap finest = mapOf(options);
  std::vector<NdtMap> levels;
  for (const double size : cell_sizes)
  {
    const double times = size / options.cell_size;
    NdtOptions own = options;
    own.cell_size = size;
    if (times == 1)
      levels.push_back(finest);
    else if (times == std::floor(times))
      levels.push_back(finest.coarser(static_cast<int>(times)));
    else
      levels.push_back(mapOf(own));
  }
  return levels;
}
}  // namespace

std::vector<NdtMap> ndtLevels(const std::vector<Eigen::Vector3f>& points, const std::vector<double>& cell_sizes,
                              NdtOptions options)
{
  return levelsOf([&](const NdtOptions& o) { return NdtMap(points, o); }, cell_sizes, options);
}

std::vector<NdtMap> ndtLevels(const std::vector<View>& views, const std::vector<double>& cell_sizes, NdtOptions options,
                              Grid grid)
{
  return levelsOf([&](const NdtOptions& o) { return NdtMap(views, o, grid); }, cell_sizes, options);
}
}  // namespace scanloom
