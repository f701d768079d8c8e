#include "lab/simulation/internal/Drive.h"

#include "base/core/Angle.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
// Assumed: plausible for a machine of 10 to 20 t.
constexpr double kWorkSway = 0.6;       // sway while the boom works, as a share of that while driving
constexpr double kVibrationSlow = 3.2;  // Hz: slow frequency of engine and hydraulics
constexpr double kVibrationFast = 5.0;  // Hz: fast frequency of engine and hydraulics
constexpr double kWheelbase = 3.5;      // m: distance of the axles: pitch and height follow the ground under them
constexpr double kTrack = 2.0;          // m: distance of the wheels of an axle: the roll follows the ground under them

constexpr double kBehindStart = 15.0;  // m, where the total station may stand

/** The angle's rate with its derivative. Its second derivative is unknown: NaN, so that a use would show. */
Taylor rateOf(const Taylor& angle) { return {angle.rate, angle.acceleration, std::nan("")}; }

Taylor oscillation(double t, double rate, double phase = 0) { return sin(2 * M_PI * rate * Taylor{t, 1, 0} + phase); }

/** Body rates of R = Rz(yaw) Ry(pitch) Rx(roll), and how they change. */
struct Turn
{
  Eigen::Vector3d rate, acceleration;
};

Turn turnOf(const Taylor& yaw, const Taylor& pitch, const Taylor& roll)
{
  const Taylor x = rateOf(roll) - rateOf(yaw) * sin(pitch);
  const Taylor y = rateOf(pitch) * cos(roll) + rateOf(yaw) * sin(roll) * cos(pitch);
  const Taylor z = rateOf(yaw) * cos(roll) * cos(pitch) - rateOf(pitch) * sin(roll);
  return {{x.value, y.value, z.value}, {x.rate, y.rate, z.rate}};
}

/** Pose of a body whose origin is at (x, y) and whose four wheels are on the ground. */
struct Stance
{
  Taylor height, pitch, roll;
};

Stance stand(const Ground& ground, const Taylor& x, const Taylor& y, const Taylor& yaw)
{
  const Taylor c = cos(yaw), s = sin(yaw);
  const auto wheel = [&](double along, double left)
  { return ground.height(x + along * c - left * s, y + along * s + left * c); };
  const double a = kWheelbase / 2, b = kTrack / 2;
  const Taylor front_left = wheel(a, b), front_right = wheel(a, -b), rear_left = wheel(-a, b),
               rear_right = wheel(-a, -b);
  const Taylor rise = 0.5 * (front_left + front_right - rear_left - rear_right);
  const Taylor bank = 0.5 * (front_left + rear_left - front_right - rear_right);
  return {0.25 * (front_left + front_right + rear_left + rear_right), -atan((1 / kWheelbase) * rise),
          atan((1 / kTrack) * bank)};
}
}  // namespace

Drive::Drive(const Route& route, const DriveOptions& options, const BodyMotionOptions& body, const Ground& ground,
             EngineVibration engine)
  : route_(route),
    body_(body),
    ground_(ground),
    engine_(std::move(engine)),
    curve_(options.curve),
    curve_rate_(2 * M_PI / options.curve_length),
    left_(options.left)
{
}

Taylor Drive::lateral(const Taylor& x) const { return curve_ * (1 - cos(curve_rate_ * x)); }

Motion Drive::at(double t) const
{
  Taylor x = route_.progress(t), y = left_ + lateral(x);
  const Taylor yaw = atan(curve_ * curve_rate_ * sin(curve_rate_ * x)) + route_.turned(t);
  Stance stance = stand(ground_, x, y, yaw);
  if (body_.upright) stance.pitch = stance.roll = 0.0;

  const Taylor driving = route_.driving(t), working = route_.working(t);
  const Taylor sway = kDegree * body_.sway_deg * (driving + kWorkSway * working);
  const Taylor shake = driving + working;
  const double slow = kVibrationSlow, fast = kVibrationFast;
  Taylor z = stance.height + body_.vibration * shake * (oscillation(t, slow) + oscillation(t, fast, 1.0));
  Taylor pitch = stance.pitch + 2.0 / 3 * sway * oscillation(t, 1.3 * body_.sway_rate, 0.9) +
                 kDegree * body_.vibration_deg * shake * oscillation(t, fast, 2.0);
  Taylor roll = stance.roll + sway * oscillation(t, body_.sway_rate) +
                kDegree * body_.vibration_deg * shake * oscillation(t, slow, 0.5);
  if (!engine_.isStill())
  {
    const Shake engine = engine_.at(t);
    x = x + engine.place[0], y = y + engine.place[1], z = z + engine.place[2];
    pitch = pitch + engine.pitch, roll = roll + engine.roll;
  }
  const Turn turn = turnOf(yaw, pitch, roll);
  return {Rigid::fromXyzYawPitchRoll(x.value, y.value, z.value, yaw.value, pitch.value, roll.value),
          {x.rate, y.rate, z.rate},
          {x.acceleration, y.acceleration, z.acceleration},
          turn.rate,
          turn.acceleration};
}

std::vector<Eigen::Vector2d> Drive::path() const
{
  // Steps of equal length, not of equal time: a machine at rest adds no points. The path is longer than its x.
  const double stretch = std::hypot(1, curve_ * curve_rate_), step = 0.25 / stretch;
  const double length = route_.farthest() * stretch;
  constexpr double kLongest = 15e3;  // m: so much forest grows in 10 s and takes 1 to 2 GB
  if (length > kLongest)
    throw std::invalid_argument(fmt::format(
        "[simulated_drive] start, duration and speed lead through {:.0f} km of forest: at most {:.0f} km can be grown",
        1e-3 * length, 1e-3 * kLongest));
  std::vector<Eigen::Vector2d> path;
  for (double x = -kBehindStart; x < 0; x += step) path.emplace_back(x, 0);
  for (double x = 0; x < route_.farthest() + step; x += step) path.emplace_back(x, lateral(x).value);
  return path;
}
}  // namespace scanloom
