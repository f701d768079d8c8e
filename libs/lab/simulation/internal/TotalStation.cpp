#include "lab/simulation/internal/TotalStation.h"

#include "base/core/Angle.h"
#include "lab/simulation/internal/Random.h"

#include <cmath>

namespace scanloom
{
namespace
{
// Assumed but for the rate.
constexpr double kStationRate = 7;      // Hz: measurements per second, with some jitter
constexpr double kStationY = 0;         // m: y of the station in the world frame
constexpr double kStationHeight = 1.7;  // m: height of the instrument above the ground

constexpr double kArcSecond = kDegree / 3600;
constexpr double kPrismRadius = 0.1;  // m: nearer things are the prism's own mount
}  // namespace

const Rigid& stationTWorld()
{
  static const Rigid station_T_world = Rigid::fromXyzYawPitchRoll(512.3, -87.1, 44.2, 137.3 * kDegree, 0, 0);
  return station_T_world;
}

TotalStation::TotalStation(const TotalStationOptions& options, const Eigen::Vector3d& body_p_prism,
                           const RecordingSpan& span, std::uint64_t seed)
  : options_(options), body_p_prism_(body_p_prism), span_(span), seed_(seed)
{
}

double TotalStation::secondsOf(std::uint64_t n) const
{
  Random random(seed_, RandomStream::TotalStation, n);
  return (static_cast<double>(n) + random.uniform(0.2, 0.4)) / kStationRate;
}

std::optional<PrismMeasurement> TotalStation::measure(const Scenery& scenery, std::uint64_t n) const
{
  Random random(seed_, RandomStream::TotalStation, 1, n);
  const double t = secondsOf(n);
  const Eigen::Vector3d prism = scenery.drive().at(t).world_T_body * body_p_prism_;
  const bool lost = random.uniform() < options_.lost;
  const std::uint64_t draw = random.bits();
  if (lost || (options_.occlusion && isHidden(scenery, t, prism, draw))) return std::nullopt;

  const Eigen::Vector3d line = (prism - eye(scenery.world())).normalized();
  const double distance = (prism - eye(scenery.world())).norm();
  Eigen::Vector3d noise, turn;
  for (double& axis : noise) axis = options_.noise * random.normal();
  for (double& axis : turn) axis = options_.angle_noise * kArcSecond * random.normal();
  const Eigen::Vector3d measured = prism + noise + distance * turn.cross(line);
  const Timestamp stamp = span_.start + fromSeconds(t) + fromSeconds(options_.stamp_offset);
  return PrismMeasurement{stamp, stationTWorld() * measured};
}

Eigen::Vector3d TotalStation::eye(const World& world) const
{
  return {options_.x, kStationY, world.ground().height(options_.x, kStationY) + kStationHeight};
}

bool TotalStation::isHidden(const Scenery& scenery, double t, const Eigen::Vector3d& prism, std::uint64_t draw) const
{
  const Eigen::Vector3d from = eye(scenery.world()), sight = prism - from;
  const double free_way = sight.norm() - kPrismRadius;
  return free_way > 0 && scenery.at(t).cast({{from, sight.normalized()}, free_way, draw}).has_value();
}
}  // namespace scanloom
