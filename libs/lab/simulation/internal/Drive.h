/** The machine's motion in closed form: poses with their exact derivatives. */
#pragma once
#include "base/core/Field.h"
#include "base/core/Rigid.h"
#include "lab/simulation/internal/EngineVibration.h"
#include "lab/simulation/internal/Ground.h"
#include "lab/simulation/internal/Route.h"
#include "lab/simulation/internal/Taylor.h"

#include <vector>

namespace scanloom
{
/** How the body sways and shakes on its way. All assumed: plausible for a machine of 10 to 20 t. */
struct BodyMotionOptions
{
  double sway_deg = 1.2;
  double sway_rate = 0.7;
  double vibration = 0.0003;    // m: amplitude of the height at each of the two vibration frequencies; 0 at rest
  double vibration_deg = 0.02;  // deg: amplitude of the roll at the slow and of the pitch at the fast frequency
  bool upright = false;         // on slopes, too, as people are

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.sway_deg, Field{"sway_deg", "deg",
                            "amplitude of the roll while driving; that of the pitch is two thirds of it (assumed)",
                            between(0, 10)});
    visit(o.sway_rate,
          Field{"sway_rate", "Hz", "frequency of the roll; the pitch is 1.3 times as fast (assumed)", between(0, 5)});
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

/** Four wheels on the ground along a winding path. Sway and vibration fade in and out with driving and working;
 * the engine's vibration goes on at rest. */
class Drive
{
 public:
  Drive(const Route&, const DriveOptions&, const BodyMotionOptions&, const Ground&, EngineVibration = {});

  /** `t` s after the start of the recording. The machine rests where t < 0, but for its engine. */
  Motion at(double t) const;

  const Ground& ground() const { return ground_; }
  const Route& route() const { return route_; }

  /**
   * Middle of the machine's lane: points (x, y) at most 0.25 m apart, from 15 m behind the axis' origin on. Throws
   * std::invalid_argument beyond 15 km.
   */
  std::vector<Eigen::Vector2d> path() const;

  /** How far the path is left of its axis, m. */
  Taylor lateral(const Taylor& x) const;

 private:
  Route route_;
  BodyMotionOptions body_;
  Ground ground_;
  EngineVibration engine_;
  double curve_;       // m
  double curve_rate_;  // rad/m
  double left_;        // m, of the path
};
}  // namespace scanloom
