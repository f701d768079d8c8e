/** The machine's motion by formula: position, velocity, acceleration and turn rates without differentiating poses. */
#pragma once
#include "core/Field.h"
#include "core/Rigid.h"
#include "simulation/Ground.h"
#include "simulation/Taylor.h"

#include <vector>

namespace scanloom
{
struct DriveOptions
{
  double duration = 22.0;
  double standstill = 2.5;
  double speed = 0.8;
  double speed_up = 2.0;
  double curve = 0.8;
  double curve_length = 22.0;
  double sway_deg = 1.2;
  double sway_rate = 0.7;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.duration, Field{"duration", "s", "length of the recording", above(0)});
    visit(o.standstill, Field{"standstill", "s", "at rest before and after the drive", atLeast(0)});
    visit(o.speed, Field{"speed", "m/s", "cruising speed", between(0, 10)});
    visit(o.speed_up, Field{"speed_up", "s", "to reach the cruising speed, and to stop", above(0)});
    visit(o.curve, Field{"curve", "m", "amplitude of the winding path", between(0, 20)});
    visit(o.curve_length, Field{"curve_length", "m", "after which the path winds again", above(1)});
    visit(o.sway_deg, Field{"sway_deg", "deg", "roll and, two thirds of it, pitch while driving", between(0, 10)});
    visit(o.sway_rate, Field{"sway_rate", "Hz", "of the roll; the pitch is 1.3 times as fast", between(0, 5)});
  }
};

/** The body at one instant. */
struct Motion
{
  Rigid world_T_body;
  Eigen::Vector3d velocity;              // m/s, of the body's origin, in the world
  Eigen::Vector3d acceleration;          // m/s2, in the world
  Eigen::Vector3d angular_rate;          // rad/s, in the body
  Eigen::Vector3d angular_acceleration;  // rad/s2, in the body
};

/** Rests, drives along a winding path on the ground with growing and fading sway, and rests again. */
class Drive
{
 public:
  /** Throws std::invalid_argument if the rests and ramps are longer than the drive. */
  Drive(const DriveOptions&, const Ground&);

  /** `t` s after the start of the recording; before and after, the machine rests. */
  Motion at(double t) const;

  /** Points of the ground that the machine covers, its tail at the start included, at most 0.25 m apart. */
  std::vector<Eigen::Vector2d> path() const;

 private:
  Taylor share(double t) const;     // of the cruising speed and of the sway: 0 at rest, 1 while cruising
  Taylor progress(double t) const;  // m along the x axis

  DriveOptions options_;
  Ground ground_;
};
}  // namespace scanloom
