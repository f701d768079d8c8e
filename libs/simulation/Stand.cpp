#include "simulation/Stand.h"

#include "simulation/Random.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scanloom
{
namespace
{
constexpr double kCellSize = 2.0;      // m
constexpr double kRootDepth = 0.5;     // m: the foot lies below the ground on any slope
constexpr double kLeastSpacing = 0.8;  // m
constexpr double kLeastRadius = 0.03;  // m

Eigen::AlignedBox2d footprint(const Stem& stem)
{
  Eigen::AlignedBox2d box(stem.foot.head<2>().eval());
  box.extend((stem.foot + stem.length * stem.axis).head<2>().eval());
  const Eigen::Vector2d radius = Eigen::Vector2d::Constant(stem.radius);
  return {box.min() - radius, box.max() + radius};
}
}  // namespace

std::optional<double> Stem::intersect(const Ray& ray) const
{
  // In the plane across the axis the stem is a circle.
  const Eigen::Vector3d from_foot = ray.origin - foot;
  const Eigen::Vector3d across = ray.direction - ray.direction.dot(axis) * axis;
  const Eigen::Vector3d offset = from_foot - from_foot.dot(axis) * axis;
  const double a = across.squaredNorm(), b = across.dot(offset), c = offset.squaredNorm() - radius * radius;
  const double discriminant = b * b - a * c;
  if (discriminant < 0 || c < 0 || b >= 0) return std::nullopt;

  const double range = (-b - std::sqrt(discriminant)) / a;
  const double along = (from_foot + range * ray.direction).dot(axis);
  if (along < 0 || along > length) return std::nullopt;
  return range;
}

Eigen::Vector3d Stem::normal(const Eigen::Vector3d& on_bark) const
{
  const Eigen::Vector3d from_foot = on_bark - foot;
  return (from_foot - from_foot.dot(axis) * axis).normalized();
}

double Stem::distanceToBark(const Eigen::Vector3d& p) const
{
  const Eigen::Vector3d from_foot = p - foot;
  return (from_foot - from_foot.dot(axis) * axis).norm() - radius;
}

Stand::Stand(std::vector<Stem> stems) : stems_(std::move(stems))
{
  if (stems_.empty()) return;
  Eigen::AlignedBox2d area;
  for (const Stem& stem : stems_) area.extend(footprint(stem));
  corner_ = area.min();
  size_ = (area.sizes().array() / kCellSize).floor().cast<int>() + 1;
  cells_.resize(static_cast<std::size_t>(size_.prod()));

  const auto cellOf = [&](const Eigen::Vector2d& p) -> Cell
  { return ((p - corner_).array() / kCellSize).floor().cast<int>(); };
  for (std::uint32_t i = 0; i < stems_.size(); ++i)
  {
    const Cell first = cellOf(footprint(stems_[i]).min()), last = cellOf(footprint(stems_[i]).max());
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) cells_[y * size_.x() + x].push_back(i);
  }
}

std::optional<Stand::Hit> Stand::intersect(const Ray& ray, double max_range) const
{
  // Amanatides and Woo: A Fast Voxel Traversal Algorithm for Ray Tracing, Eurographics 1987; in two dimensions.
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Eigen::Array2d start = (ray.origin.head<2>() - corner_).array() / kCellSize;
  const Eigen::Array2d step_per_metre = ray.direction.head<2>().array() / kCellSize;
  Cell cell = start.floor().cast<int>(), step;
  Eigen::Array2d next_border, between_borders;  // m along the ray
  for (int i = 0; i < 2; ++i)
  {
    step[i] = step_per_metre[i] < 0 ? -1 : 1;
    between_borders[i] = step_per_metre[i] == 0 ? kNever : std::abs(1 / step_per_metre[i]);
    const double to_border = step[i] > 0 ? cell[i] + 1 - start[i] : start[i] - cell[i];
    next_border[i] = step_per_metre[i] == 0 ? kNever : to_border * between_borders[i];
  }

  std::optional<Hit> nearest;
  for (double entered = 0; entered < (nearest ? nearest->range : max_range);)
  {
    if (contains(cell))
      for (const std::uint32_t i : stemsIn(cell))
        if (const auto range = stems_[i].intersect(ray); range && *range < (nearest ? nearest->range : max_range))
          nearest = Hit{*range, &stems_[i]};

    const int axis = next_border.x() < next_border.y() ? 0 : 1;
    entered = next_border[axis];
    next_border[axis] += between_borders[axis];
    cell[axis] += step[axis];
  }
  return nearest;
}

std::vector<Stem> growStems(const StandOptions& options, const Ground& ground, const Eigen::AlignedBox2d& area,
                            const std::vector<Eigen::Vector2d>& path, std::uint64_t seed)
{
  constexpr double kSquareMetresPerHectare = 1e4;
  const auto wanted = static_cast<std::uint64_t>(options.stems_per_hectare * area.volume() / kSquareMetresPerHectare);

  std::vector<Stem> stems;
  for (std::uint64_t i = 0; i < wanted; ++i)
  {
    Random random(seed, RandomStream::Stand, i);
    const Eigen::Vector2d place(random.uniform(area.min().x(), area.max().x()),
                                random.uniform(area.min().y(), area.max().y()));
    const Eigen::Vector2d lean = options.tilt_deg * M_PI / 180 * Eigen::Vector2d(random.normal(), random.normal());
    Stem stem;
    stem.foot << place, ground.height(place.x(), place.y()) - kRootDepth;
    stem.axis = Eigen::Vector3d(lean.x(), lean.y(), 1).normalized();
    stem.radius = std::max(kLeastRadius, 0.5 * (options.diameter + options.diameter_spread * random.normal()));
    stem.length = random.uniform(12, 20);

    const auto tooNear = [&](const Stem& other) { return (other.foot - stem.foot).head<2>().norm() < kLeastSpacing; };
    const auto inTheWay = [&](const Eigen::Vector2d& p) { return (p - place).norm() < options.free_lane; };
    if (std::none_of(stems.begin(), stems.end(), tooNear) && std::none_of(path.begin(), path.end(), inTheWay))
      stems.push_back(stem);
  }
  return stems;
}
}  // namespace scanloom
