#include "lab/simulation/internal/Buildings.h"

#include "base/core/Angle.h"
#include "lab/simulation/internal/Random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
using BoxList = std::vector<OrientedBox>;

/** Places along the path, by the distance from its begin. */
class Way
{
 public:
  explicit Way(const std::vector<Eigen::Vector2d>& path) : path_(path)
  {
    along_.push_back(0);
    for (std::size_t i = 1; i < path.size(); ++i) along_.push_back(along_.back() + (path[i] - path[i - 1]).norm());
  }

  double length() const { return along_.back(); }

  /** x along the way, y to its left; heading along it. */
  Rigid at(double along, double left, double height) const
  {
    const auto next = std::lower_bound(along_.begin() + 1, along_.end() - 1, along) - along_.begin();
    const auto i = static_cast<std::size_t>(next);
    const Eigen::Vector2d ahead = (path_[i] - path_[i - 1]).normalized();
    const Eigen::Vector2d place =
        path_[i - 1] + (along - along_[i - 1]) * ahead + left * Eigen::Vector2d(-ahead.y(), ahead.x());
    return Rigid::fromXyzYawPitchRoll(place.x(), place.y(), height, std::atan2(ahead.y(), ahead.x()), 0, 0);
  }

  Eigen::AlignedBox2d bounds() const
  {
    Eigen::AlignedBox2d box(path_.front());
    for (const Eigen::Vector2d& place : path_) box.extend(place);
    return box;
  }

  /** The least distance of a place from the path, m. */
  double distanceTo(const Eigen::Vector2d& place) const
  {
    double least = (path_.front() - place).norm();
    for (const Eigen::Vector2d& point : path_) least = std::min(least, (point - place).norm());
    return least;
  }

 private:
  std::vector<Eigen::Vector2d> path_;
  std::vector<double> along_;
};

/** A box that stands at a height: the given frame lies in the middle of its foot. */
OrientedBox standing(const Rigid& foot, const Eigen::Vector3d& size)
{
  return {foot * Rigid{Eigen::Quaterniond::Identity(), {0, 0, 0.5 * size.z()}}, 0.5 * size};
}

OrientedBox between(const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
  return {Rigid{Eigen::Quaterniond::Identity(), 0.5 * (low + high)}, 0.5 * (high - low)};
}

/** A car of two boxes: body and cabin. */
void addCar(const Rigid& foot, BoxList& boxes)
{
  const auto above = [&](double x, double z) { return foot * Rigid{Eigen::Quaterniond::Identity(), {x, 0, z}}; };
  boxes.push_back(standing(above(0, 0.25), {4.3, 1.8, 0.6}));
  boxes.push_back(standing(above(-0.3, 0.85), {2.3, 1.6, 0.6}));
}

/** Walls of thickness 0.3 m around a rectangle, from the ground up. */
void addWalls(const Eigen::AlignedBox2d& floor, double height, BoxList& boxes)
{
  constexpr double kThick = 0.3;
  const Eigen::Vector2d low = floor.min(), high = floor.max();
  const auto wall = [&](double x0, double y0, double x1, double y1) {
    boxes.push_back(between({x0, y0, -1}, {x1, y1, height}));
  };
  wall(low.x() - kThick, low.y() - kThick, high.x() + kThick, low.y());
  wall(low.x() - kThick, high.y(), high.x() + kThick, high.y() + kThick);
  wall(low.x() - kThick, low.y(), low.x(), high.y());
  wall(high.x(), low.y(), high.x() + kThick, high.y());
}

void addCeiling(const Eigen::AlignedBox2d& floor, double height, BoxList& boxes)
{
  boxes.push_back(
      between({floor.min().x(), floor.min().y(), height}, {floor.max().x(), floor.max().y(), height + 0.3}));
}

Eigen::AlignedBox2d around(const Eigen::AlignedBox2d& path, double along, double across)
{
  const Eigen::Vector2d margin(along, across);
  return {path.min() - margin, path.max() + margin};
}

/** House fronts 8 m off the path with bays and doorways, parked cars at the kerb, lamp posts. */
BoxList street(const Way& way, Random random)
{
  BoxList boxes;
  for (const double side : {1.0, -1.0})
  {
    for (double from = -20; from < way.length() + 60;)
    {
      const double width = random.uniform(8, 18), depth = random.uniform(8, 12), height = random.uniform(6, 15);
      const double front = 8 + random.uniform(0, 1.5), middle = from + 0.5 * width;
      boxes.push_back(standing(way.at(middle, side * (front + 0.5 * depth), -1), {width, depth, height}));
      for (double bay = from + 1.5; bay < from + width - 1; bay += random.uniform(2.5, 4.5))
        boxes.push_back(standing(way.at(bay, side * front, random.uniform(-1, 3)), {1.2, 0.5, random.uniform(2, 3)}));
      from += width + (random.uniform() < 0.3 ? random.uniform(2, 8) : 0);
    }
    for (double along = -15; along < way.length() + 50; along += 6)
      if (random.uniform() < 0.6)
        addCar(way.at(along + random.uniform(-0.5, 0.5), side * (5.2 + random.uniform(-0.2, 0.2)), 0), boxes);
    for (double along = 10; along < way.length() + 50; along += 27)
      boxes.push_back(standing(way.at(along, side * 6.6, 0), {0.15, 0.15, 6}));
  }
  return boxes;
}

/** A hall of 8 m height with pillars along its walls and machines beside the path. */
BoxList hall(const Way& way, Random random)
{
  constexpr double kHeight = 8;
  const Eigen::AlignedBox2d floor = around(way.bounds(), 10, 14);
  BoxList boxes;
  addWalls(floor, kHeight, boxes);
  addCeiling(floor, kHeight, boxes);
  for (double x = floor.min().x() + 3; x < floor.max().x(); x += 8)
    for (const double y : {floor.min().y() + 0.2, floor.max().y() - 0.2})
      boxes.push_back(between({x - 0.2, y - 0.2, 0}, {x + 0.2, y + 0.2, kHeight}));
  for (double x = floor.min().x() + 2; x < floor.max().x() - 2; x += 5)
    for (double y = floor.min().y() + 2; y < floor.max().y() - 2; y += 5)
    {
      const Eigen::Vector2d place(x + random.uniform(-1, 1), y + random.uniform(-1, 1));
      const Eigen::Vector3d size(random.uniform(0.8, 3), random.uniform(0.8, 2), random.uniform(0.8, 2.5));
      const double yaw = kDegree * 90 * std::floor(random.uniform(0, 4)) + random.uniform(-0.1, 0.1);
      if (random.uniform() < 0.35 || way.distanceTo(place) < 3.5) continue;
      const Rigid foot = Rigid::fromXyzYawPitchRoll(place.x(), place.y(), 0, yaw, 0, 0);
      boxes.push_back(standing(foot, size));
      const Eigen::Vector3d part(0.4 * size.x(), 0.4 * size.y(), random.uniform(0.3, 1));
      boxes.push_back(standing(foot * Rigid{Eigen::Quaterniond::Identity(), {0.2, 0.1, size.z()}}, part));
    }
  return boxes;
}

/** One storey: flat, a ceiling 2.6 m up with beams, pillars every 7.5 m, some places taken. */
BoxList carPark(const Way& way, Random random)
{
  constexpr double kHeight = 2.6, kBay = 7.5;
  const Eigen::AlignedBox2d floor = around(way.bounds(), 12, 17);
  BoxList boxes;
  addWalls(floor, kHeight, boxes);
  addCeiling(floor, kHeight, boxes);
  for (double x = floor.min().x() + 4; x < floor.max().x(); x += kBay)
  {
    boxes.push_back(between({x - 0.15, floor.min().y(), kHeight - 0.3}, {x + 0.15, floor.max().y(), kHeight}));
    for (double y = floor.min().y() + 4; y < floor.max().y(); y += kBay)
    {
      if (way.distanceTo({x, y}) > 2.5) boxes.push_back(between({x - 0.2, y - 0.2, 0}, {x + 0.2, y + 0.2, kHeight}));
      const Eigen::Vector2d place(x + 0.5 * kBay, y);
      if (random.uniform() < 0.3 && way.distanceTo(place) > 4.5)
        addCar(Rigid::fromXyzYawPitchRoll(place.x(), place.y(), 0, 90 * kDegree, 0, 0), boxes);
    }
  }
  return boxes;
}

/** A hedge 40 m to the left of the path, of bushes of different sizes; on the other side there is nothing. */
BoxList hedge(const Way& way, Random random)
{
  BoxList boxes;
  for (double along = -60; along < way.length() + 60; along += random.uniform(0.6, 1.4))
  {
    const Rigid foot = way.at(along, 40 + random.uniform(-0.6, 0.6), -1);
    const Rigid turned = foot * Rigid::fromXyzYawPitchRoll(0, 0, 0, random.uniform(-M_PI, M_PI), 0, 0);
    boxes.push_back(standing(turned, {random.uniform(0.8, 2), random.uniform(0.8, 2), random.uniform(2.5, 4.5)}));
  }
  return boxes;
}

/** Walls 1.3 m off the path, a ceiling at 2.6 m, doorways at uneven distances. */
BoxList corridor(const Way& way, Random random)
{
  constexpr double kHeight = 2.6, kRecess = 0.15, kDoor = 1;
  const Eigen::AlignedBox2d floor = around(way.bounds(), 4, 1.3);
  BoxList boxes;
  addWalls(around(way.bounds(), 4, 1.3 + kRecess), kHeight, boxes);
  addCeiling(around(way.bounds(), 4, 1.3 + kRecess), kHeight, boxes);
  // Between two doorways the wall stands out by their depth.
  for (const double y : {floor.min().y() - kRecess, floor.max().y()})
    for (double x = floor.min().x(); x < floor.max().x();)
    {
      const double end = std::min(x + random.uniform(2, 9), floor.max().x());
      boxes.push_back(between({x, y, -1}, {end, y + kRecess, kHeight}));
      x = end + kDoor;
    }
  return boxes;
}

/** A corridor over the ground's slopes, with a step of 0.3 m at a time and a ceiling that follows them. */
BoxList stairs(const Way& way, const Ground& ground, Random random)
{
  constexpr double kTread = 0.3, kRoom = 2.7, kWide = 1.4;
  const Eigen::AlignedBox2d floor = around(way.bounds(), 4, kWide);
  BoxList boxes;
  addWalls(floor, ground.highest() + kRoom + 1, boxes);
  for (double x = floor.min().x(); x < floor.max().x(); x += kTread)
  {
    const double z = ground.height(x + 0.5 * kTread, 0.0);
    boxes.push_back(between({x, floor.min().y(), z - 1}, {x + kTread, floor.max().y(), z}));
    boxes.push_back(between({x, floor.min().y(), z + kRoom}, {x + kTread, floor.max().y(), z + kRoom + 0.5}));
  }
  for (double x = floor.min().x() + 2; x < floor.max().x(); x += random.uniform(3, 7))  // posts of the hand rail
  {
    const double z = ground.height(x, 0.0), y = random.uniform() < 0.5 ? floor.min().y() : floor.max().y() - 0.1;
    boxes.push_back(between({x, y, z - 1}, {x + 0.1, y + 0.1, z + 1}));
  }
  return boxes;
}
}  // namespace

std::vector<OrientedBox> build(const BuildingOptions& options, const Drive& drive, std::uint64_t seed)
{
  if (options.kind == "none") return {};
  const Way way(drive.path());
  const Random random(seed, RandomStream::Buildings, 0);
  if (options.kind == "street") return street(way, random);
  if (options.kind == "hall") return hall(way, random);
  if (options.kind == "car_park") return carPark(way, random);
  if (options.kind == "hedge") return hedge(way, random);
  if (options.kind == "corridor") return corridor(way, random);
  if (options.kind == "stairs") return stairs(way, drive.ground(), random);
  throw std::invalid_argument(
      fmt::format("[simulated_buildings] kind = '{}': must be none, street, hall, car_park, "
                  "hedge, corridor or stairs",
                  options.kind));
}
}  // namespace scanloom
