/** What moves about the machine: a person, a vehicle, and the trees that it fells. All as functions of time. */
#pragma once
#include "simulation/Drive.h"
#include "simulation/Solids.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
struct ObjectOptions
{
  double person_every = 60;
  double person_speed = 2.78;
  double person_height = 1.75;
  double person_width = 0.5;
  double vehicle_every = 120;
  double vehicle_speed = 2.78;
  double vehicle_length = 4.2;
  double vehicle_width = 1.9;
  double vehicle_height = 1.7;
  double pass_distance = 9;
  double pass_length = 60;
  bool felled_trees = true;
  double tree_length = 16;
  double tree_diameter = 0.24;
  double tree_taper = 0.2;
  double tree_distance = 6.5;
  double fall_time = 3;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.person_every, Field{"person_every", "s", "a person runs past so often; 0: never (assumed)", atLeast(0)});
    visit(o.person_speed, Field{"person_speed", "m/s", "10 km/h", above(0)});
    visit(o.person_height, Field{"person_height", "m", "a cylinder (assumed)", between(0.1, 3)});
    visit(o.person_width, Field{"person_width", "m", "its diameter (assumed)", between(0.1, 3)});
    visit(o.vehicle_every,
          Field{"vehicle_every", "s", "a vehicle drives past so often; 0: never (assumed)", atLeast(0)});
    visit(o.vehicle_speed, Field{"vehicle_speed", "m/s", "of the vehicle (assumed)", above(0)});
    visit(o.vehicle_length, Field{"vehicle_length", "m", "a box (assumed)", between(0.1, 30)});
    visit(o.vehicle_width, Field{"vehicle_width", "m", "of the box (assumed)", between(0.1, 10)});
    visit(o.vehicle_height, Field{"vehicle_height", "m", "of the box (assumed)", between(0.1, 10)});
    visit(o.pass_distance,
          Field{"pass_distance", "m", "from the machine, 0.6 to 1.4 times as far (assumed)", between(2, 100)});
    visit(o.pass_length,
          Field{"pass_length", "m", "of their straight ways, on which they appear and vanish (assumed)", above(1)});
    visit(o.felled_trees, Field{"felled_trees", "", "true: at every stop for work a tree falls"});
    visit(o.tree_length, Field{"tree_length", "m", "of that tree (assumed)", between(1, 60)});
    visit(o.tree_diameter, Field{"tree_diameter", "m", "at its foot (assumed)", between(0.02, 2)});
    visit(o.tree_taper,
          Field{"tree_taper", "", "diameter at its top, share of that at its foot (assumed)", between(0, 1)});
    visit(o.tree_distance,
          Field{"tree_distance", "m", "of its foot from the machine's origin (assumed)", between(3, 30)});
    visit(o.fall_time, Field{"fall_time", "s", "from upright to lying (assumed)", between(0.5, 20)});
  }
};

enum class ObjectKind
{
  Person,
  Vehicle,
  Tree,
};

/** One of them at one instant. */
struct MovingObject
{
  std::uint64_t id = 0;
  ObjectKind kind = ObjectKind::Person;
  Eigen::Vector3d ground_point = Eigen::Vector3d::Zero();  // under its centre; of a tree: its foot
  double yaw = 0;                                          // rad, of its way; of a tree: where it falls
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();      // m/s
  Eigen::Vector3d size = Eigen::Vector3d::Zero();          // m: length, width, height (upright)
  double taper = 1;                                        // of a tree: diameter at its top, share of that at its foot
  double tilt = 0;                                         // rad, of a tree, from upright
  bool moves = true;                                       // a tree only while it falls
};

/** Persons are cylinders, vehicles boxes, trees cones. */
std::vector<Cone> conesOf(const std::vector<MovingObject>&);
std::vector<OrientedBox> boxesOf(const std::vector<MovingObject>&);

class MovingObjects
{
 public:
  MovingObjects(const ObjectOptions&, const Drive&, std::uint64_t seed);

  /** Those that are there, `t` s after the start, in the order of their ids. */
  std::vector<MovingObject> at(double t) const;

 private:
  struct FelledTree
  {
    Eigen::Vector3d foot;
    double yaw;          // of its fall
    double appears;      // s; stands from then on
    double falls, gone;  // s
  };

  void addPassers(std::vector<MovingObject>&, ObjectKind, double t) const;
  void addTrees(std::vector<MovingObject>&, double t) const;
  void planTrees();

  ObjectOptions options_;
  Drive drive_;
  std::uint64_t seed_;
  std::vector<FelledTree> trees_;  // by the number of the drive
};
}  // namespace scanloom
