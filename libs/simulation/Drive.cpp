#include "simulation/Drive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
/** 0 to 1 over one unit with two continuous derivatives (K. Perlin: Improving Noise, SIGGRAPH 2002), and its integral.
 */
struct SmoothStep
{
  double integral, value, first, second;
};

SmoothStep smoothStep(double u)
{
  if (u <= 0) return {0, 0, 0, 0};
  if (u >= 1) return {0.5 + (u - 1), 1, 0, 0};
  return {((u - 3) * u + 2.5) * u * u * u * u, ((6 * u - 15) * u + 10) * u * u * u, ((30 * u - 60) * u + 30) * u * u,
          ((120 * u - 180) * u + 60) * u};
}

constexpr double kLengthBehindOrigin = 4.0;  // m of machine

/** The angle's rate as a quantity of its own; its second derivative is not known and must not be used. */
Taylor rateOf(const Taylor& angle) { return {angle.rate, angle.acceleration, std::nan("")}; }
}  // namespace

Drive::Drive(const DriveOptions& options, const Ground& ground) : options_(options), ground_(ground)
{
  const double least = 2 * (options.standstill + options.speed_up);
  if (options.duration < least)
    throw std::invalid_argument(
        fmt::format("duration = {} s: must be at least 2 (standstill + speed_up) = {} s", options.duration, least));
}

Taylor Drive::share(double t) const
{
  const double T = options_.speed_up;
  const SmoothStep start = smoothStep((t - options_.standstill) / T);
  const SmoothStep stop = smoothStep((t - (options_.duration - options_.standstill - T)) / T);
  return {start.value - stop.value, (start.first - stop.first) / T, (start.second - stop.second) / (T * T)};
}

Taylor Drive::progress(double t) const
{
  const double T = options_.speed_up;
  const SmoothStep start = smoothStep((t - options_.standstill) / T);
  const SmoothStep stop = smoothStep((t - (options_.duration - options_.standstill - T)) / T);
  const Taylor moving = share(t);
  return {options_.speed * T * (start.integral - stop.integral), options_.speed * moving.value,
          options_.speed * moving.rate};
}

Motion Drive::at(double t) const
{
  const Taylor x = progress(t);
  const double k = 2 * M_PI / options_.curve_length;
  const Taylor y = options_.curve * (1 - cos(k * x));
  const Taylor z = ground_.height(x, y);

  const Taylor time{t, 1, 0};
  const Taylor sway = options_.sway_deg * M_PI / 180 * share(t);
  const Taylor yaw = atan(options_.curve * k * sin(k * x));
  const Taylor pitch = 2.0 / 3 * sway * sin(2 * M_PI * 1.3 * options_.sway_rate * time + 0.9);
  const Taylor roll = sway * sin(2 * M_PI * options_.sway_rate * time);

  // The rates of R = Rz(yaw) Ry(pitch) Rx(roll) about the body's own axes.
  const Taylor turn[3] = {rateOf(roll) - rateOf(yaw) * sin(pitch),
                          rateOf(pitch) * cos(roll) + rateOf(yaw) * sin(roll) * cos(pitch),
                          rateOf(yaw) * cos(roll) * cos(pitch) - rateOf(pitch) * sin(roll)};
  return {Rigid::fromXyzYawPitchRoll(x.value, y.value, z.value, yaw.value, pitch.value, roll.value),
          {x.rate, y.rate, z.rate},
          {x.acceleration, y.acceleration, z.acceleration},
          {turn[0].value, turn[1].value, turn[2].value},
          {turn[0].rate, turn[1].rate, turn[2].rate}};
}

std::vector<Eigen::Vector2d> Drive::path() const
{
  const int steps = static_cast<int>(std::ceil(options_.duration * std::max(options_.speed, 0.1) / 0.1));
  std::vector<Eigen::Vector2d> path;
  for (double x = -kLengthBehindOrigin; x < 0; x += 0.25) path.emplace_back(x, 0);
  for (int i = 0; i <= steps; ++i) path.push_back(at(options_.duration * i / steps).world_T_body.translation.head<2>());
  return path;
}
}  // namespace scanloom
