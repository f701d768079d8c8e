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
  double work_sway = 0.6;
  double vibration = 0.0003;
  double vibration_deg = 0.02;
  double vibration_slow = 3.2;
  double vibration_fast = 5.0;
  double wheelbase = 3.5;
  double track = 2.0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.sway_deg, Field{"sway_deg", "deg",
                            "amplitude of the roll while driving; that of the pitch is two thirds of it (assumed)",
                            between(0, 10)});
    visit(o.sway_rate,
          Field{"sway_rate", "Hz", "frequency of the roll; the pitch is 1.3 times as fast (assumed)", between(0, 5)});
    visit(o.work_sway, Field{"work_sway", "", "sway while the boom works, as a share of that while driving (assumed)",
                             between(0, 1)});
    visit(o.vibration, Field{"vibration", "m",
                             "amplitude of the height at each of the two vibration frequencies; 0 at rest (assumed)",
                             between(0, 0.02)});
    visit(o.vibration_deg,
          Field{"vibration_deg", "deg",
                "amplitude of the roll at the slow and of the pitch at the fast frequency (assumed)", between(0, 1)});
    visit(o.vibration_slow,
          Field{"vibration_slow", "Hz", "slow frequency of engine and hydraulics (assumed)", between(0, 100)});
    visit(o.vibration_fast,
          Field{"vibration_fast", "Hz", "fast frequency of engine and hydraulics (assumed)", between(0, 100)});
    visit(o.wheelbase,
          Field{"wheelbase", "m", "distance of the axles: pitch and height follow the ground under them (assumed)",
                above(0.1)});
    visit(o.track,
          Field{"track", "m", "distance of the wheels of an axle: the roll follows the ground under them (assumed)",
                above(0.1)});
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

  /** Where the machine drives: points (x, y) at most 0.25 m apart, from 15 m behind the start on. */
  std::vector<Eigen::Vector2d> path() const;

 private:
  Taylor lateral(const Taylor& x) const;

  Route route_;
  BodyMotionOptions body_;
  Ground ground_;
  EngineVibration engine_;
  double curve_;       // m
  double curve_rate_;  // rad/m
};
}  // namespace scanloom
