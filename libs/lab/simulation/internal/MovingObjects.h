/** What moves around the machine, as functions of time: persons, vehicles, and the trees that it fells. */
#pragma once
#include "lab/simulation/internal/Drive.h"
#include "lab/simulation/internal/Solids.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
/** The tree that falls at each stop for work. */
struct FelledTreeOptions
{
  bool felled_trees = true;
  double tree_length = 16;
  double tree_diameter = 0.24;
  double tree_taper = 0.2;
  double tree_distance = 6.5;
  double fall_time = 3;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.felled_trees, Field{"felled_trees", "", "whether a tree falls at every stop for work"});
    visit(o.tree_length, Field{"tree_length", "m", "length of that tree (assumed)", between(1, 60)});
    visit(o.tree_diameter,
          Field{"tree_diameter", "m", "diameter of that tree at its foot (assumed)", between(0.02, 2)});
    visit(o.tree_taper,
          Field{"tree_taper", "", "diameter at its top as a share of that at its foot (assumed)", between(0, 1)});
    visit(o.tree_distance,
          Field{"tree_distance", "m", "distance of its foot from the machine's origin (assumed)", between(3, 30)});
    visit(o.fall_time, Field{"fall_time", "s", "time of its fall, from upright to lying (assumed)", between(0.5, 20)});
  }
};

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
  FelledTreeOptions trees;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.person_every,
          Field{"person_every", "s", "mean time between two persons who run past; 0: none (assumed)", atLeast(0)});
    visit(o.person_speed, Field{"person_speed", "m/s", "speed of a person; 2.78 m/s are 10 km/h", above(0)});
    visit(o.person_height,
          Field{"person_height", "m", "height of the cylinder that a person is (assumed)", between(0.1, 3)});
    visit(o.person_width, Field{"person_width", "m", "diameter of that cylinder (assumed)", between(0.1, 3)});
    visit(o.vehicle_every,
          Field{"vehicle_every", "s", "mean time between two vehicles that drive past; 0: none (assumed)", atLeast(0)});
    visit(o.vehicle_speed, Field{"vehicle_speed", "m/s", "speed of a vehicle (assumed)", above(0)});
    visit(o.vehicle_length,
          Field{"vehicle_length", "m", "length of the box that a vehicle is (assumed)", between(0.1, 30)});
    visit(o.vehicle_width, Field{"vehicle_width", "m", "width of that box (assumed)", between(0.1, 10)});
    visit(o.vehicle_height, Field{"vehicle_height", "m", "height of that box (assumed)", between(0.1, 10)});
    visit(o.pass_distance,
          Field{"pass_distance", "m", "mean distance at which they pass the machine; 0.6 to 1.4 times this (assumed)",
                between(2, 100)});
    visit(o.pass_length, Field{"pass_length", "m",
                               "length of the straight path at whose ends they appear and vanish (assumed)", above(1)});
    FelledTreeOptions::fields(o.trees, visit);
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
  void addTrees(std::vector<MovingObject>&, double t) const;
  void planTrees();

  ObjectOptions options_;
  Drive drive_;
  std::uint64_t seed_;
  std::vector<FelledTree> trees_;  // by the number of the drive
};
}  // namespace scanloom
