#include "simulation/SimulatedLidar.h"

#include "simulation/Machine.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kMillimetre = 1e-3;
constexpr double kRadians = M_PI / 180;
constexpr double kLeastRange = 0.3;          // m, OS0 data sheet: minimum range
constexpr double kRangeAtTenPercent = 35.0;  // m, OS0 data sheet rev. 7: range at 10 % reflectivity
constexpr double kLargestRange = 50.0;       // m, OS0 data sheet: maximum range of the representative modes

double reflectivityOf(Surface surface)
{
  switch (surface)
  {
    case Surface::Ground:
      return 0.15;
    case Surface::Stem:
    case Surface::Branch:
      return 0.30;
    case Surface::Crown:
    case Surface::Undergrowth:
      return 0.40;
    case Surface::Machine:
    case Surface::Boom:
    case Surface::Object:
      return 0.60;
  }
  return 0;
}

/** Certain to 0.7 of the range where half of the returns would be lost, then falling linearly. */
double chanceOfReturn(double range, double reflectivity)
{
  const double reach = kRangeAtTenPercent * std::sqrt(reflectivity / 0.10);
  return std::clamp((1.3 - range / reach) / 0.6, 0.0, 1.0);
}

Rigid fromMillimetres(Eigen::Matrix4d matrix)
{
  matrix.topRightCorner<3, 1>() *= kMillimetre;
  return Rigid::fromMatrix(matrix);
}
}  // namespace

SimulatedLidar::SimulatedLidar(OusterMetadata metadata, const Rigid& body_T_sensor, const LidarTiming& timing,
                               const LidarErrors& errors)
  : metadata_(std::move(metadata)),
    body_T_sensor_(body_T_sensor),
    body_T_lidar_(body_T_sensor * fromMillimetres(metadata_.lidar_to_sensor_mm)),
    timing_(timing),
    errors_(errors),
    beam_radius_(kMillimetre * metadata_.beam_to_lidar_mm(0, 3)),
    beam_height_(kMillimetre * metadata_.beam_to_lidar_mm(2, 3))
{
  for (int beam = 0; beam < metadata_.channels; ++beam)
  {
    const double azimuth = -kRadians * metadata_.beam_azimuth_deg[beam];  // the file's azimuths are clockwise
    const double altitude = kRadians * metadata_.beam_altitude_deg[beam];
    beam_directions_.emplace_back(std::cos(azimuth) * std::cos(altitude), std::sin(azimuth) * std::cos(altitude),
                                  std::sin(altitude));
  }
}

Timestamp SimulatedLidar::stampOf(Timestamp start, std::uint64_t column) const
{
  const double nominal = 1 / (metadata_.frame_rate * metadata_.columns_per_frame);
  const double since_first = static_cast<double>(column) * nominal * (1 + 1e-6 * timing_.rate_error_ppm);
  return start + timing_.first_stamp + fromSeconds(since_first);
}

OusterColumn SimulatedLidar::measure(const World& world, const Drive& drive, Timestamp start,
                                     std::uint64_t column) const
{
  const std::uint64_t columns_since_frame = timing_.first_measurement_id + column;
  OusterColumn measured;
  measured.stamp = stampOf(start, column);
  measured.frame_id =
      timing_.first_frame_id + static_cast<std::uint32_t>(columns_since_frame / metadata_.columns_per_frame);
  measured.measurement_id = static_cast<std::uint16_t>(columns_since_frame % metadata_.columns_per_frame);

  const Rigid world_T_body = drive.at(seconds(measured.stamp - start)).world_T_body;
  const double turn = 2 * M_PI * (1 - static_cast<double>(measured.measurement_id) / metadata_.columns_per_frame);
  const Eigen::Quaterniond encoder(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
  const Rigid world_T_rotor = world_T_body * body_T_lidar_ * Rigid{encoder, Eigen::Vector3d::Zero()};
  const Eigen::Vector3d origin = world_T_rotor * Eigen::Vector3d(beam_radius_, 0, beam_height_);
  const Eigen::Matrix3d world_R_rotor = world_T_rotor.rotation.toRotationMatrix();

  Random random(errors_.seed, errors_.stream, column);
  for (const Eigen::Vector3d& direction : beam_directions_)
    measured.readings.push_back(measureBeam(world, world_T_body, {origin, world_R_rotor * direction}, random));
  return measured;
}

OusterReading SimulatedLidar::measureBeam(const World& world, const Rigid& world_T_body, const Ray& ray,
                                          Random& random) const
{
  // Every beam draws the same number of times, so that one lost return does not change its neighbours.
  const std::uint64_t draw = random.bits();
  const double noise = errors_.range_noise * random.normal();
  const double luck = random.uniform();
  const double shade = random.normal();

  OusterReading measured;
  measured.near_ir = static_cast<std::uint16_t>(std::max(0.0, 400 + 40 * shade));
  auto hit = castMachine(world_T_body, ray);
  if (!hit) hit = world.cast(ray, kLargestRange, draw);  // nothing else is so near to the machine
  if (!hit || hit->range < kLeastRange) return measured;
  const double reflectivity = reflectivityOf(hit->surface) * (1 + 0.1 * shade);
  if (luck >= chanceOfReturn(hit->range, reflectivity)) return measured;

  // The sensor's range is counted from the axis of rotation, along the path of the light: radius, then beam.
  const double origin_to_axis = std::hypot(beam_radius_, beam_height_);
  const double range_mm = (hit->range + noise + origin_to_axis) / kMillimetre;
  measured.first.range_mm = static_cast<std::uint32_t>(std::lround(range_mm));
  measured.first.reflectivity = static_cast<std::uint8_t>(std::clamp(100 * reflectivity, 1.0, 100.0));
  const double photons = 3e5 * reflectivity * hit->cosine_incidence / (hit->range * hit->range);
  measured.first.signal = static_cast<std::uint16_t>(std::clamp(photons, 1.0, 65535.0));
  return measured;
}
}  // namespace scanloom
