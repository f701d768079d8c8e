#include "lab/simulation/internal/SimulatedLidar.h"

#include "base/core/Angle.h"
#include "input/lidar/AzimuthWindow.h"
#include "input/lidar/OusterDecoder.h"
#include "input/lidar/OusterProfiles.h"

#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kMillimetre = 1e-3;

/** A ray of a beam, uniformly distributed within a cone of `divergence` rad (full angle). */
Eigen::Vector3d besideAxis(const Eigen::Vector3d& axis, double divergence, Random& random)
{
  const double off = 0.5 * divergence * std::sqrt(random.uniform()), around = random.uniform(0, 2 * M_PI);
  const Eigen::Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
  return (axis + off * (std::cos(around) * u + std::sin(around) * v)).normalized();
}
}  // namespace

SimulatedLidar::SimulatedLidar(OusterMetadata metadata, const Rigid& body_T_sensor, const LidarTiming& timing,
                               const RangingOptions& ranging, const PrecipitationOptions& precipitation,
                               std::uint64_t seed, std::uint64_t place)
  : metadata_(std::move(metadata)),
    body_T_lidar_(body_T_sensor * rigidFromMillimetres(metadata_.lidar_to_sensor_mm)),
    timing_(timing),
    seed_(seed),
    place_(place),
    two_returns_(layoutOf(metadata_).profile->returns() == 2),
    beam_radius_(kMillimetre * metadata_.beam_to_lidar_mm(0, 3)),
    beam_height_(kMillimetre * metadata_.beam_to_lidar_mm(2, 3)),
    // The sensor adds the distance of the beam's origin from the axis of rotation to its ranges.
    receiver_(ranging, metadata_.product_line, std::hypot(beam_radius_, beam_height_), precipitation)
{
  for (int beam = 0; beam < metadata_.channels; ++beam)
  {
    const double azimuth = -kDegree * metadata_.beam_azimuth_deg[beam];  // azimuths in the metadata are clockwise
    const double altitude = kDegree * metadata_.beam_altitude_deg[beam];
    beam_directions_.emplace_back(std::cos(azimuth) * std::cos(altitude), std::sin(azimuth) * std::cos(altitude),
                                  std::sin(altitude));
  }
}

bool SimulatedLidar::sends(std::uint16_t measurement_id) const { return inAzimuthWindow(metadata_, measurement_id); }

MeasuredColumn SimulatedLidar::measure(const Scenery& scenery, std::uint64_t column) const
{
  const ColumnInstant instant = instantOf(column);
  MeasuredColumn measured;
  measured.column.stamp = instant.stamp;
  measured.column.frame_id = instant.frame_id;
  measured.column.measurement_id = instant.measurement_id;
  measured.column.valid = sends(instant.measurement_id);
  if (!measured.column.valid) return measured;

  const Moment moment = scenery.at(seconds(instant.truth - timing_.start));
  const double turn = 2 * M_PI * (1 - static_cast<double>(instant.measurement_id) / metadata_.columns_per_frame);
  const Eigen::Quaterniond encoder(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
  const Rigid world_T_rotor = moment.worldTBody() * body_T_lidar_ * Rigid{encoder, Eigen::Vector3d::Zero()};
  const Eigen::Vector3d origin = world_T_rotor * Eigen::Vector3d(beam_radius_, 0, beam_height_);
  const Eigen::Matrix3d world_R_rotor = world_T_rotor.rotation.toRotationMatrix();

  // Every ray takes the same number of random numbers: a lost return does not change its neighbours.
  std::vector<RayQuery> queries;
  std::vector<Luck> lucks;
  const auto add = [&](const Eigen::Vector3d& direction, Random& random)
  {
    queries.push_back({{origin, world_R_rotor * direction}, receiver_.options().farthest_range, random.bits()});
    lucks.emplace_back(random);
  };
  Random random(seed_, RandomStream::Lidar, place_, column), random_beside(seed_, RandomStream::Beside, place_, column);
  for (const Eigen::Vector3d& direction : beam_directions_) add(direction, random);
  if (two_returns_)
    for (const Eigen::Vector3d& direction : beam_directions_)
      add(besideAxis(direction, kDegree * kBeamDivergenceDeg, random_beside), random_beside);

  const std::vector<std::optional<Hit>> hits = moment.cast(queries);
  const auto echo = [&](std::size_t ray) { return Echo{hits[ray], lucks[ray]}; };
  Random of_specks(seed_, RandomStream::Precipitation, place_, column);
  const auto echoOnAxis = [&](std::size_t ray) {
    return Echo{hits[ray], lucks[ray], receiver_.precipitation().draw(of_specks)};
  };
  const std::size_t beams = beam_directions_.size();
  for (std::size_t beam = 0; beam < beams; ++beam)
  {
    const Reception reception =
        two_returns_ ? receiver_.receive(echoOnAxis(beam), echo(beams + beam)) : receiver_.receive(echoOnAxis(beam));
    measured.column.readings.push_back(reception.reading);
    measured.returns.add(reception.surface);
  }
  return measured;
}
}  // namespace scanloom
