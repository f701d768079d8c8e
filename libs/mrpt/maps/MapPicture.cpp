#include "mrpt/maps/MapPicture.h"

#include "base/formats/Canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr double kVoxel = 0.1;  // m, height, and width unless widened
constexpr int kVoxelsPerGroundCell = 10;
constexpr double kSliceBottom = 1.0;  // m above ground, around breast height (1.3 m)
constexpr double kSliceTop = 1.6;
constexpr double kGroundTop = 0.4;
constexpr int kTitleHeight = 40, kLegendHeight = 64, kBorder = 50, kLeastWidth = 860;

const Color kPaper{0.98F, 0.98F, 0.97F}, kInk{0.15F, 0.16F, 0.18F}, kGrid{0.72F, 0.72F, 0.72F};
const Color kVegetation{0.55F, 0.74F, 0.45F}, kStem{0.30F, 0.16F, 0.07F}, kPath{0.87F, 0.18F, 0.12F};
const Color kGoodLink{0.13F, 0.35F, 0.78F}, kBadLink{0.95F, 0.60F, 0.05F};
const Color kLowGround{0.79F, 0.85F, 0.90F}, kHighGround{0.93F, 0.86F, 0.72F};

using Voxel = Eigen::Array3i;
constexpr int kKeyBits = 21;
constexpr int kKeyOffset = 1 << (kKeyBits - 1);  // +-104 km

std::uint64_t pictureKey(const Voxel& voxel)
{
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) key = key << kKeyBits | static_cast<std::uint64_t>(voxel[axis] + kKeyOffset);
  return key;
}

Voxel voxelOf(std::uint64_t key)
{
  constexpr std::uint64_t kMask = (1ULL << kKeyBits) - 1;
  const auto part = [&](int axis) { return static_cast<int>(key >> (kKeyBits * (2 - axis)) & kMask) - kKeyOffset; };
  return {part(0), part(1), part(2)};
}

int floorDivide(int a, int by) { return a / by - (a % by < 0 ? 1 : 0); }

Voxel widened(const Voxel& voxel, int times)
{
  const int by = 1 << times;
  return {floorDivide(voxel.x(), by), floorDivide(voxel.y(), by), voxel.z()};
}

/** Elevation of the ground in cells of ten voxels: the lowest voxel of each, smoothed over its neighbours. */
class Ground
{
 public:
  explicit Ground(const std::vector<Voxel>& voxels)
  {
    for (const Voxel& voxel : voxels)
    {
      const auto [cell, is_new] = lowest_.try_emplace(cellOf(voxel), voxel.z());
      if (!is_new) cell->second = std::min(cell->second, voxel.z());
    }
    for (const auto& [cell, lowest] : lowest_) elevation_[cell] = lowerQuartileAround(cell);
  }

  double elevation(const Voxel& voxel) const { return kVoxel * elevation_.at(cellOf(voxel)); }
  double heightAbove(const Voxel& voxel) const { return kVoxel * voxel.z() - elevation(voxel); }

 private:
  using Cell = std::pair<int, int>;

  static Cell cellOf(const Voxel& voxel)
  {
    return {floorDivide(voxel.x(), kVoxelsPerGroundCell), floorDivide(voxel.y(), kVoxelsPerGroundCell)};
  }

  // Robust against an outlier below the ground, and against a cell where only a crown was seen.
  int lowerQuartileAround(const Cell& cell) const
  {
    std::vector<int> around;
    for (int dx = -2; dx <= 2; ++dx)
      for (int dy = -2; dy <= 2; ++dy)
        if (const auto found = lowest_.find({cell.first + dx, cell.second + dy}); found != lowest_.end())
          around.push_back(found->second);
    std::sort(around.begin(), around.end());
    return around[around.size() / 4];
  }

  std::map<Cell, int> lowest_, elevation_;
};

/** Map coordinates to pixels; y of the map is up. */
struct View
{
  Eigen::Vector2d lower, upper;  // m, what is shown
  double scale;                  // pixels per metre
  double voxel;                  // m, width
  int left, top, width, height;  // pixels

  Eigen::Vector2d pixel(double x, double y) const
  {
    return {left + scale * (x - lower.x()), top + scale * (upper.y() - y)};
  }
  Eigen::Vector2d lowerCornerOf(const Voxel& at) const { return voxel * at.head<2>().cast<double>().matrix(); }
  bool shows(const Eigen::Vector2d& p) const
  {
    return (p.array() >= lower.array()).all() && (p.array() < upper.array()).all();
  }
};

View viewAround(const std::vector<Trajectory>& paths, const MapPictureOptions& options, double voxel)
{
  Eigen::AlignedBox2d box;
  for (const Trajectory& path : paths)
    for (const StampedPose& pose : path) box.extend(pose.map_T_body.translation.head<2>().eval());
  if (box.isEmpty()) throw std::invalid_argument("the picture of the map needs a pose");
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(options.margin);
  const Eigen::Vector2d extent = box.sizes() + 2 * margin;
  const double scale = (options.longest_side - 2 * kBorder) / extent.maxCoeff();
  const int width = static_cast<int>(std::ceil(scale * extent.x()));
  const int height = static_cast<int>(std::ceil(scale * extent.y()));
  return {box.min() - margin,
          box.max() + margin,
          scale,
          voxel,
          std::max(kBorder, (kLeastWidth - width) / 2),
          kTitleHeight,
          width,
          height};
}

void paintCell(Canvas& canvas, const View& view, const Voxel& voxel, const Color& color, float opacity)
{
  const Eigen::Vector2d lower = view.lowerCornerOf(voxel);
  if (!view.shows(lower)) return;
  const Eigen::Vector2d from = view.pixel(lower.x(), lower.y() + view.voxel),
                        to = view.pixel(lower.x() + view.voxel, lower.y());
  for (int y = std::max(view.top, static_cast<int>(from.y())); y < std::ceil(to.y()) && y < view.top + view.height; ++y)
    for (int x = static_cast<int>(from.x()); x < std::ceil(to.x()) && x < view.left + view.width; ++x)
      canvas.blend(x, y, color, opacity);
}

void paintMap(Canvas& canvas, const View& view, const std::vector<Voxel>& voxels)
{
  const Ground ground(voxels);
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Voxel& voxel : voxels)
    if (view.shows(view.lowerCornerOf(voxel)))
    {
      lowest = std::min(lowest, ground.elevation(voxel));
      highest = std::max(highest, ground.elevation(voxel));
    }

  const auto inSlice = [](double height) { return height >= kSliceBottom && height < kSliceTop; };
  for (const Voxel& voxel : voxels)
  {
    const float share = static_cast<float>((ground.elevation(voxel) - lowest) / std::max(0.5, highest - lowest));
    const Color shade = kLowGround * (1 - share) + kHighGround * share;
    if (ground.heightAbove(voxel) < kGroundTop) paintCell(canvas, view, voxel, shade, 0.9F);
  }
  for (const Voxel& voxel : voxels)
  {
    const double height = ground.heightAbove(voxel);
    if (height >= kGroundTop && !inSlice(height)) paintCell(canvas, view, voxel, kVegetation, 0.05F);
  }
  for (const Voxel& voxel : voxels)
    if (inSlice(ground.heightAbove(voxel))) paintCell(canvas, view, voxel, kStem, 0.45F);
}

/** 1, 2 or 5 times a power of ten: the largest not above `length`. */
double roundLength(double length)
{
  const double decade = std::pow(10.0, std::floor(std::log10(length)));
  const double share = length / decade;
  return decade * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
}

void paintGrid(Canvas& canvas, const View& view)
{
  const double step = roundLength((view.upper - view.lower).maxCoeff() / 4);
  for (double x = step * std::ceil(view.lower.x() / step); x <= view.upper.x(); x += step)
  {
    const int column = static_cast<int>(view.pixel(x, 0).x());
    for (int y = view.top; y < view.top + view.height; ++y) canvas.blend(column, y, kGrid, 0.5F);
    const std::string label = fmt::format("{:g}", std::abs(x) < 1e-9 ? 0.0 : x);
    canvas.text(column - Canvas::textWidth(label, Canvas::Font::Small) / 2, view.top + view.height + 4, label,
                Canvas::Font::Small, kInk);
  }
  for (double y = step * std::ceil(view.lower.y() / step); y <= view.upper.y(); y += step)
  {
    const int row = static_cast<int>(view.pixel(0, y).y());
    for (int x = view.left; x < view.left + view.width; ++x) canvas.blend(x, row, kGrid, 0.5F);
    const std::string label = fmt::format("{:g}", std::abs(y) < 1e-9 ? 0.0 : y);
    canvas.text(view.left - 6 - Canvas::textWidth(label, Canvas::Font::Small), row - 6, label, Canvas::Font::Small,
                kInk);
  }
}

void paintLink(Canvas& canvas, const View& view, const MapLink& link)
{
  const Color& color = link.is_good ? kGoodLink : kBadLink;
  const Eigen::Vector2d to = view.pixel(link.to.x(), link.to.y());
  canvas.line(view.pixel(link.from.x(), link.from.y()), to, 2, color);
  canvas.disc(to, 4, color);  // the line is short where both paths are beside each other
}

void paintPath(Canvas& canvas, const View& view, const Trajectory& trajectory)
{
  if (trajectory.empty()) return;
  const auto pixel = [&](const StampedPose& pose)
  { return view.pixel(pose.map_T_body.translation.x(), pose.map_T_body.translation.y()); };
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    canvas.line(pixel(trajectory[i - 1]), pixel(trajectory[i]), 3.0, kPath);
  canvas.disc(pixel(trajectory.front()), 7, kPath);
  canvas.disc(pixel(trajectory.front()), 4, kPaper);
  canvas.disc(pixel(trajectory.back()), 7, kPath);
}

void paintLegend(Canvas& canvas, const View& view, bool has_links)
{
  const int y = canvas.height() - 26;
  const double bar = roundLength(view.width / view.scale / 5);
  const int bar_end = kBorder + static_cast<int>(bar * view.scale);
  canvas.fillRectangle(kBorder, y, bar_end - kBorder, 3, kInk);
  for (const int end : {kBorder, bar_end}) canvas.fillRectangle(end - 1, y - 5, 2, 13, kInk);
  canvas.text(kBorder + 6, y - 16, fmt::format("{:g} m", bar), Canvas::Font::Small, kInk);

  const int columns = std::max(bar_end + 40, canvas.width() - kBorder - (has_links ? 640 : 480));
  const auto entry = [&](int x, const Color& color, const std::string& meaning)
  {
    canvas.fillRectangle(columns + x, y - 4, 12, 12, color);
    canvas.text(columns + x + 18, y - 5, meaning, Canvas::Font::Small, kInk);
  };
  entry(0, kStem, fmt::format("{:.1f} to {:.1f} m high", kSliceBottom, kSliceTop));
  entry(150, kVegetation, "vegetation");
  entry(250, kHighGround, "ground: high");
  entry(362, kLowGround, "low");
  entry(414, kPath, "path");
  if (!has_links) return;
  entry(474, kGoodLink, "loop");
  entry(534, kBadLink, "refused");
}
}  // namespace

void MapPicture::add(const Keyframe& keyframe)
{
  for (std::size_t i = 0; i < keyframe.points.size(); ++i)
  {
    const Eigen::Vector3d position = keyframe.map_T_body * keyframe.points.position(i).cast<double>().eval();
    voxels_.insert(pictureKey(widened((position / kVoxel).array().floor().cast<int>(), widened_)));
  }
  while (voxels_.size() > options_.most_voxels) widen();
}

/** The keyframes' order does not matter: what is left is what all of them, widened so often, have. */
void MapPicture::widen()
{
  ++widened_;
  std::unordered_set<std::uint64_t> wider;
  for (const std::uint64_t key : voxels_) wider.insert(pictureKey(widened(voxelOf(key), 1)));
  voxels_ = std::move(wider);
}

void MapPicture::write(const std::filesystem::path& file, const std::vector<Trajectory>& paths,
                       const std::string& title, const std::vector<MapLink>& links) const
{
  std::vector<std::uint64_t> keys(voxels_.begin(), voxels_.end());
  std::sort(keys.begin(), keys.end());  // so that the picture does not depend on the order of the hash set
  std::vector<Voxel> voxels;
  std::transform(keys.begin(), keys.end(), std::back_inserter(voxels), voxelOf);

  const View view = viewAround(paths, options_, std::ldexp(kVoxel, widened_));
  Canvas canvas(2 * view.left + view.width, kTitleHeight + view.height + kLegendHeight, kPaper);
  canvas.text(kBorder, 12, title, Canvas::Font::Large, kInk);
  paintMap(canvas, view, voxels);
  paintGrid(canvas, view);
  for (const Trajectory& path : paths) paintPath(canvas, view, path);
  for (const MapLink& link : links) paintLink(canvas, view, link);
  paintLegend(canvas, view, !links.empty());
  canvas.savePng(file);
}
}  // namespace scanloom
