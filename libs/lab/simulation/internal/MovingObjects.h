/** What moves around the machine, as functions of time: persons, vehicles, and the trees that it fells. */
#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/Drive.h"
#include "lab/simulation/internal/Solids.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
/** How many objects there are. Sizes and distances are assumed; only tests change them. */
struct ObjectOptions
{
  double person_every = 60;     // s: mean time between two persons who run past; 0: none
  double vehicle_every = 120;   // s: mean time between two vehicles that drive past; 0: none
  double vehicle_height = 1.7;  // m: height of that box
  double pass_distance = 9;     // m: mean distance at which they pass the machine; 0.6 to 1.4 times this
  bool felled_trees = true;     // a tree falls at every stop for work
  double traffic_every = 0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.person_every, Field{"person_every", "s", "time between two persons who run past; 0: none", atLeast(0)});
    visit(o.vehicle_every,
          Field{"vehicle_every", "s", "time between two vehicles that cross the path; 0: none", atLeast(0)});
    visit(o.traffic_every, Field{"traffic_every", "s",
                                 "time between two cars that come towards the machine on the other lane, with another "
                                 "that keeps 20 m ahead of it; 0: none",
                                 atLeast(0)});
  }
};

enum class ObjectKind
{
  Person,
  Vehicle,
  Tree,
};

/** One object at one instant. */
struct MovingObject
{
  std::uint64_t id = 0;
  ObjectKind kind = ObjectKind::Person;
  Eigen::Vector3d ground_point = Eigen::Vector3d::Zero();  // under its centre; for a tree its foot
  double yaw = 0;                                          // rad, direction of motion; for a tree that of its fall
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();      // m/s
  Eigen::Vector3d size = Eigen::Vector3d::Zero();          // m: length, width, height (upright)
  double taper = 1;   // of a tree: diameter at its top as a share of that at its foot
  double tilt = 0;    // rad, of a tree, from upright
  bool moves = true;  // a tree moves only while it falls
};

/** Shapes in the world: persons are cylinders, vehicles boxes, trees cones. */
std::vector<Cone> conesOf(const std::vector<MovingObject>&);
std::vector<OrientedBox> boxesOf(const std::vector<MovingObject>&);

class MovingObjects
{
 public:
  MovingObjects(const ObjectOptions&, const Drive&, std::uint64_t seed);

  /** Those present `t` s after the start, by id. */
  std::vector<MovingObject> at(double t) const;

 private:
  struct FelledTree
  {
    Eigen::Vector3d foot;
    double yaw;          // of its fall
    double appears;      // s
    double falls, gone;  // s
  };

  void addPassers(std::vector<MovingObject>&, ObjectKind, double t) const;
  void addTraffic(std::vector<MovingObject>&, double t) const;
  MovingObject carOnLane(std::uint64_t number, double x, double left, double speed) const;
  void addTrees(std::vector<MovingObject>&, double t) const;
  void planTrees();

  ObjectOptions options_;
  Drive drive_;
  std::uint64_t seed_;
  std::vector<FelledTree> trees_;  // by the number of the drive
};
}  // namespace scanloom
