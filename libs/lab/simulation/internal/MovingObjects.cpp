#include "lab/simulation/internal/MovingObjects.h"

#include "lab/simulation/internal/Random.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scanloom
{
namespace
{
// Assumed.
constexpr double kPersonSpeed = 2.78;   // m/s: speed of a person; 2.78 m/s are 10 km/h
constexpr double kPersonHeight = 1.75;  // m: height of the cylinder that a person is
constexpr double kPersonWidth = 0.5;    // m: diameter of that cylinder
constexpr double kVehicleSpeed = 2.78;  // m/s: speed of a vehicle
constexpr double kVehicleLength = 4.2;  // m: length of the box that a vehicle is
constexpr double kVehicleWidth = 1.9;   // m: width of that box
constexpr double kPassLength = 60;      // m: length of the straight path at whose ends they appear and vanish
constexpr double kTreeLength = 16;      // m: length of a felled tree
constexpr double kTreeDiameter = 0.24;  // m: diameter of that tree at its foot
constexpr double kTreeTaper = 0.2;      // diameter at its top as a share of that at its foot
constexpr double kTreeDistance = 6.5;   // m: distance of its foot from the machine's origin
constexpr double kFallTime = 3;         // s: time of its fall, from upright to lying

constexpr double kShortestStop = 8;  // s: no tree falls at a shorter one
constexpr double kLying = M_PI / 2;  // rad

// Traffic (assumed).
constexpr double kLanes = 3.2;                 // m: from the machine's lane to the one of oncoming cars
constexpr double kOncomingSpeed = 10;          // m/s
constexpr double kCarAhead = 20;               // m: the car ahead is so far away, give or take kCarAheadSway
constexpr double kCarAheadSway = 4;            // m
constexpr std::uint64_t kTraffic = 1'000'000;  // numbers of its cars; those of passers are smaller

constexpr std::uint64_t kKinds = 3;
/** Ids of the kinds alternate, so that no two objects have the same. */
std::uint64_t idOf(ObjectKind kind, std::uint64_t number) { return kKinds * number + static_cast<std::uint64_t>(kind); }

/** Angle of the fall as a share of the whole, `u` the share of its time: it falls faster and faster. */
double fallenShare(double u)
{
  const double v = std::clamp(u, 0.0, 1.0);
  return v * v;
}
}  // namespace

std::vector<Cone> conesOf(const std::vector<MovingObject>& objects)
{
  std::vector<Cone> cones;
  for (const MovingObject& object : objects)
  {
    const double radius = 0.5 * object.size.y();
    if (object.kind == ObjectKind::Person)
      cones.push_back({object.ground_point, Eigen::Vector3d::UnitZ(), object.size.z(), radius, radius});
    if (object.kind != ObjectKind::Tree) continue;
    const Eigen::Vector3d away(std::cos(object.yaw), std::sin(object.yaw), 0);
    const Eigen::Vector3d axis = std::cos(object.tilt) * Eigen::Vector3d::UnitZ() + std::sin(object.tilt) * away;
    cones.push_back({object.ground_point, axis, object.size.z(), radius, object.taper * radius});
  }
  return cones;
}

std::vector<OrientedBox> boxesOf(const std::vector<MovingObject>& objects)
{
  std::vector<OrientedBox> boxes;
  for (const MovingObject& object : objects)
  {
    if (object.kind != ObjectKind::Vehicle) continue;
    const Eigen::Vector3d centre = object.ground_point + 0.5 * object.size.z() * Eigen::Vector3d::UnitZ();
    boxes.emplace_back(Rigid::fromXyzYawPitchRoll(centre.x(), centre.y(), centre.z(), object.yaw, 0, 0),
                       0.5 * object.size);
  }
  return boxes;
}

MovingObjects::MovingObjects(const ObjectOptions& options, const Drive& drive, std::uint64_t seed)
  : options_(options), drive_(drive), seed_(seed)
{
  if (options_.felled_trees) planTrees();
}

void MovingObjects::planTrees()
{
  const Route& route = drive_.route();
  double appears = -std::numeric_limits<double>::infinity();
  for (std::uint64_t i = 0; i < route.legs(); ++i)
  {
    FelledTree tree{{}, 0, appears, 0, -std::numeric_limits<double>::infinity()};
    if (const auto stop = route.workStop(i))
    {
      Random random(seed_, RandomStream::FelledTrees, i);
      const Rigid world_T_body = drive_.at(stop->begin).world_T_body;
      const double heading = world_T_body.yawPitchRoll().x();
      const double side = random.uniform() < 0.5 ? -1 : 1;
      const double bearing = heading + side * random.uniform(0.4, 1.0);  // rad: ahead, and beside the lane
      const Eigen::Vector2d foot =
          world_T_body.translation.head<2>() + kTreeDistance * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
      tree.foot << foot, drive_.ground().height(foot.x(), foot.y());
      tree.yaw = bearing + random.uniform(-0.5, 0.5);
      tree.falls = stop->begin + 0.3 * (stop->end - stop->begin);
      if (stop->end - stop->begin >= kShortestStop) tree.gone = stop->end;
      appears = stop->begin;
    }
    trees_.push_back(tree);
  }
}

std::vector<MovingObject> MovingObjects::at(double t) const
{
  std::vector<MovingObject> objects;
  addPassers(objects, ObjectKind::Person, t);
  addPassers(objects, ObjectKind::Vehicle, t);
  addTraffic(objects, t);
  addTrees(objects, t);
  std::sort(objects.begin(), objects.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return objects;
}

void MovingObjects::addPassers(std::vector<MovingObject>& objects, ObjectKind kind, double t) const
{
  const bool is_person = kind == ObjectKind::Person;
  const double every = is_person ? options_.person_every : options_.vehicle_every;
  const double speed = is_person ? kPersonSpeed : kVehicleSpeed;
  if (every <= 0) return;
  const double half_time = 0.5 * kPassLength / speed;
  const auto first = static_cast<std::int64_t>(std::floor((t - half_time) / every));
  const auto last = static_cast<std::int64_t>(std::floor((t + half_time) / every));
  for (std::int64_t i = std::max<std::int64_t>(first, 0); i <= last; ++i)
  {
    const auto number = static_cast<std::uint64_t>(i);
    Random random(seed_, RandomStream::Passers, static_cast<std::uint64_t>(kind), number);
    const double passes = (static_cast<double>(i) + random.uniform(0.2, 0.8)) * every;
    if (std::abs(t - passes) > half_time) continue;

    const double yaw = random.uniform(-M_PI, M_PI), side = random.uniform() < 0.5 ? -1 : 1;
    const Eigen::Vector2d along(std::cos(yaw), std::sin(yaw)), across(-along.y(), along.x());
    const double distance = options_.pass_distance * random.uniform(0.6, 1.4);
    const Eigen::Vector2d machine = drive_.at(passes).world_T_body.translation.head<2>();
    const Eigen::Vector2d at = machine + side * distance * across + speed * (t - passes) * along;
    MovingObject object;
    object.id = idOf(kind, number);
    object.kind = kind;
    object.ground_point << at, drive_.ground().height(at.x(), at.y());
    object.yaw = yaw;
    object.velocity = speed * along;
    if (is_person)
      object.size << kPersonWidth, kPersonWidth, kPersonHeight;
    else
      object.size << kVehicleLength, kVehicleWidth, options_.vehicle_height;
    objects.push_back(object);
  }
}

/** Cars on the road that the machine's path is: one ahead, and those that come towards it. */
void MovingObjects::addTraffic(std::vector<MovingObject>& objects, double t) const
{
  if (options_.traffic_every <= 0) return;
  const Route& route = drive_.route();
  const double ahead = kCarAhead + kCarAheadSway * std::sin(0.3 * t);
  const Taylor progress = route.progress(t);
  objects.push_back(carOnLane(0, progress.value + ahead, 0, progress.rate + 0.3 * kCarAheadSway * std::cos(0.3 * t)));
  const double visible = 4 * kPassLength / kOncomingSpeed;  // s before and after it passes
  for (auto i = static_cast<std::int64_t>(std::floor((t - visible) / options_.traffic_every));
       i <= static_cast<std::int64_t>(std::floor((t + visible) / options_.traffic_every)); ++i)
  {
    const double passes = static_cast<double>(i) * options_.traffic_every;
    const double x = route.progress(passes).value - kOncomingSpeed * (t - passes);
    if (i >= 0 && std::abs(t - passes) < visible)
      objects.push_back(carOnLane(static_cast<std::uint64_t>(i) + 1, x, kLanes, -kOncomingSpeed));
  }
}

/** `x` along the axis of the machine's path, `left` of it; a negative speed is against the machine's. */
MovingObject MovingObjects::carOnLane(std::uint64_t number, double x, double left, double speed) const
{
  const Taylor y = drive_.lateral(Taylor{x, 1, 0});
  const Eigen::Vector2d along = Eigen::Vector2d(1, y.rate).normalized();
  const Eigen::Vector2d at = Eigen::Vector2d(x, y.value) + left * Eigen::Vector2d(-along.y(), along.x());
  MovingObject car;
  car.id = idOf(ObjectKind::Vehicle, kTraffic + number);
  car.kind = ObjectKind::Vehicle;
  car.ground_point << at, drive_.ground().height(at.x(), at.y());
  car.yaw = std::atan2(along.y(), along.x()) + (speed < 0 ? M_PI : 0);
  car.velocity = speed * along;
  car.size << kVehicleLength, kVehicleWidth, options_.vehicle_height;
  return car;
}

/** The tree of this stop, or of the one that the machine drives to, and that of the next stop. */
void MovingObjects::addTrees(std::vector<MovingObject>& objects, double t) const
{
  const std::uint64_t current = drive_.route().legNumberAt(t);
  for (std::uint64_t i = current; i <= current + 1 && i < trees_.size(); ++i)
  {
    const FelledTree& tree = trees_[i];
    if (t < tree.appears || t >= tree.gone) continue;
    MovingObject object;
    object.id = idOf(ObjectKind::Tree, i);
    object.kind = ObjectKind::Tree;
    object.ground_point = tree.foot;
    object.yaw = tree.yaw;
    object.size << kTreeDiameter, kTreeDiameter, kTreeLength;
    object.taper = kTreeTaper;
    object.tilt = kLying * fallenShare((t - tree.falls) / kFallTime);
    object.moves = t >= tree.falls && t <= tree.falls + kFallTime;
    objects.push_back(object);
  }
}
}  // namespace scanloom
